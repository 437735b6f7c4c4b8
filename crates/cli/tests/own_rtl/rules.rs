//! The rules of the channels beside a design of another hand: they look at its own ports.

use super::{edgewalk, edit, folder, told};
use std::fs;
use std::process::Command;

/// A design whose tokens are right in the clocks in which they move, and that breaks a rule of the handshake while they wait: the
/// bench of its description finds each by itself.
#[test]
fn waiting_token_must_stay_as_it_is() {
    // The ports, and what makes them of the registers that they were.
    const VALID: &str = "  reg phase, m_v;\n  always @(posedge aclk) phase <= aresetn && !phase;\n\
        assign m_valid = m_v && (m_ready || phase);\n";
    const DATA: &str = "  reg [67:0] m_d;\n  assign m_data = m_ready ? m_d : ~m_d;\n";
    const WAITS: &str = "  reg m_v;\n  assign m_valid = m_v && m_ready;\n";
    for (port, kept, made, said) in [
        ("m_valid", "m_v", WAITS, "frag: frag_valid waits for frag_ready, which it must not:"),
        ("m_valid", "m_v", VALID, "valid fell before the token was taken"),
        ("m_data", "m_d", DATA, "the token changed before it was taken"),
    ] {
        let folder = folder();
        let file = folder.path().join("my_pixel.v");
        let text = fs::read_to_string(&file).expect("a file");
        let (ports, body) = text.split_once(");\n").expect("a port list");
        let ports = ports.lines().map(|line| match line.contains("output") && line.contains(port) {
            true => line.replace("output reg ", "output wire"),
            false => line.to_owned(),
        });
        let ports = ports.collect::<Vec<_>>().join("\n");
        let body = match port {
            "m_valid" => {
                body.replace("m_valid", kept).replace("!m_v || m_ready", "!m_v || (m_ready && m_valid)")
            }
            _ => body.replace(port, kept),
        };
        fs::write(&file, format!("{ports});\n{made}{body}")).expect("written");
        let arguments = ["verify", "--dut", "pixel.toml", "--simulator", "icarus", "--only", "flat_top"];
        let (code, text) = told(&edgewalk(folder.path(), &arguments));
        assert_eq!(code, Some(1), "{port}: {text}");
        assert!(text.contains(said) && !text.contains("expected "), "{port} without `{said}`: {text}");
    }
}

#[test]
fn rules_look_at_ports_of_another_hand() {
    for (unit, fault, rule) in [
        ("pixel", ("if (!m_valid || m_ready) begin", "begin"), "rule broken: frag: time "),
        (
            "depth",
            ("rgb[free] <= f_rgb", "rgb[free] <= f_rgb ^ {24{1'bx}}"),
            "unknown bits in a token that moves",
        ),
    ] {
        let folder = folder();
        let dut = format!("{unit}.toml");
        let arguments = ["vectors", "--dut", &dut, "--suite", "hazards", "--no-csv", "--quiet", "--out", "v"];
        let (code, text) = told(&edgewalk(folder.path(), &arguments));
        assert_eq!(code, Some(0), "{text}");
        let made = || {
            let directory = folder.path().join(format!("v/hazards_{unit}"));
            let mut make = Command::new("make");
            make.env_remove("MAKEFLAGS").arg("-C").arg(directory).args(["icarus", "RULES=1"]);
            told(&make.output().expect("make is installed"))
        };
        let (code, text) = made();
        assert_eq!(code, Some(0), "{text}");
        assert!(text.contains("at work") && !text.contains("rule broken"), "{text}");
        edit(folder.path(), &format!("my_{unit}.v"), fault.0, fault.1);
        let (code, text) = made();
        assert!(code == Some(2) && text.contains(rule), "{text}");
    }
}
