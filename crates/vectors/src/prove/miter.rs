//! Two designs under the same inputs, and whether a port that counts differs, as Verilog.

use edgewalk_lockstep::{Direction, Interface, Link, Port, status_ports};
use edgewalk_machine::Until;
use edgewalk_netlist::Netlist;
use edgewalk_netlist::mutate::DIFFERS;
use std::fmt::Write as _;

/// The input of a lane of SETUP that says that a result is given out, and its register in the miter.
const GIVE: &str = "give";
const GIVEN: &str = "given";

/// The ports of both designs but clock and reset.
pub struct Ports {
    inputs: Vec<(String, u32)>,
    /// Inputs that change at a reset only.
    constants: Vec<String>,
    outputs: Vec<(String, u32)>,
    /// Outputs that count; with the port that must be 1 for it.
    compared: Vec<(String, Option<String>)>,
    /// Registers of the miter: high from a token to the clock in which a condition, in Verilog, ends its time.
    windows: Vec<Window>,
}

/// The cycles in which values that a unit holds beside a link count: from a token there to the next triangle.
struct Window {
    /// Name of the register.
    name: String,
    /// The port that says that a token is offered.
    valid: String,
    /// The condition under which the next triangle is taken.
    taken: String,
}

impl Window {
    /// Of a link of the interface, if values are held beside it.
    fn of(interface: &Interface, link: &Link) -> Option<Window> {
        let taken = interface.links_of(Direction::In).next().filter(|_| link.holds())?;
        let mut condition = format!("{0}_valid && {0}_ready", taken.name);
        if let Some(Until::TakenWith(flag)) = link.held_until {
            let _ = write!(condition, " && {}", taken.fields[taken.place(flag)?].name);
        }
        let valid = format!("{}_valid", link.name);
        Some(Window { name: format!("{}_kept", link.name), valid, taken: condition })
    }
}

impl Ports {
    /// Ports of a module: every output counts in every cycle.
    pub fn of_module(module: &Netlist) -> Ports {
        let inputs = module.inputs.iter().map(|input| (input.name.clone(), module.width(input.node)));
        let outputs = module.outputs.iter().map(|output| (output.name.clone(), module.width(output.driver)));
        Ports {
            inputs: inputs.collect(),
            constants: Vec::new(),
            outputs: outputs.collect(),
            compared: module.outputs.iter().map(|output| (output.name.clone(), None)).collect(),
            windows: Vec::new(),
        }
    }

    /// Ports of a module that goes on from clock to clock: every output counts. The value that a lane of SETUP gives out
    /// counts a clock after `give`, when SETUP takes it: a first value that SETUP takes before, SETUP takes again then.
    pub fn of_running_module(module: &Netlist) -> Ports {
        let mut ports = Ports::of_module(module);
        if gives_out(module) {
            let values = ports.compared.iter_mut().filter(|(output, _)| output == "value");
            values.for_each(|(_, during)| *during = Some(GIVEN.to_owned()));
        }
        ports
    }

    /// Ports of a unit: outputs count as in lock step.
    pub fn of_unit(interface: &Interface) -> Ports {
        let status = status_ports(interface).into_iter();
        let status = status.map(|status| (status.port.name, status.during.map(str::to_owned)));
        let of_link = |link: &Link| {
            let valid = format!("{}_valid", link.name);
            let ports: Vec<String> = match link.direction {
                Direction::Out => link.fields.iter().map(|field| field.name.clone()).collect(),
                Direction::In => vec![format!("{}_ready", link.name)],
            };
            ports.into_iter().map(move |port| (port, Some(valid.clone())))
        };
        // Held values count between the tokens too.
        let windows = interface.links.iter().filter_map(|link| Some((link, Window::of(interface, link)?)));
        let (held, windows): (Vec<_>, Vec<Window>) = windows
            .map(|(link, window)| {
                let during = Some(window.name.clone());
                (link.held().iter().map(move |port| (port.name.clone(), during.clone())), window)
            })
            .unzip();
        Ports {
            inputs: widths(interface.inputs()),
            constants: interface.constants.iter().map(|port| port.name.clone()).collect(),
            outputs: widths(interface.outputs()),
            compared: status
                .chain(interface.links.iter().flat_map(of_link))
                .chain(held.into_iter().flatten())
                .collect(),
            windows,
        }
    }
}

/// The module is a lane of SETUP.
pub fn gives_out(module: &Netlist) -> bool {
    module.inputs.iter().any(|input| input.name == GIVE)
}

fn widths(ports: &[Port]) -> Vec<(String, u32)> {
    ports.iter().map(|port| (port.name.clone(), port.width())).collect()
}

/// The module `miter` of the modules `original` and `faulty`; its output `bad` is 1 where they differ.
pub fn miter(ports: &Ports, original: &Netlist, faulty: &Netlist) -> String {
    let range = |width: u32| format!("[{}:0]", width - 1);
    let mut header = String::from("input clk, input rst");
    let mut body = String::from(
        "reg started;\ninitial started = 1'b0;\nalways @(posedge clk) if (rst) started <= 1'b1;\n",
    );
    let mut shared: Vec<String> = Vec::new();
    for (port, width) in &ports.inputs {
        let range = range(*width);
        if ports.constants.contains(port) {
            let _ = write!(header, ", input {range} {port}_in");
            let _ =
                writeln!(body, "reg {range} {port};\nalways @(posedge clk) if (rst) {port} <= {port}_in;");
        } else {
            let _ = write!(header, ", input {range} {port}");
        }
        shared.push(port.clone());
    }
    if ports.compared.iter().any(|(_, during)| during.as_deref() == Some(GIVEN)) {
        let _ = writeln!(body, "reg {GIVEN};\nalways @(posedge clk) {GIVEN} <= {GIVE};");
    }
    for (port, width) in &ports.outputs {
        let _ = writeln!(body, "wire {} {port}, other_{port};", range(*width));
    }
    for Window { name, valid, taken } in &ports.windows {
        let _ = writeln!(
            body,
            "reg {name};\ninitial {name} = 1'b0;\n\
             always @(posedge clk) {name} <= !rst && !({taken}) && ({name} || {valid});"
        );
    }
    let connections = |netlist: &Netlist, prefix: &str| {
        // A fault may take away the only register with a reset, and the port with it.
        let clock = [(netlist.has_clock, "clk"), (netlist.has_reset, "rst")];
        let clock = clock.into_iter().filter(|(has, _)| *has).map(|(_, name)| name);
        let inputs = clock.chain(shared.iter().map(String::as_str)).map(|port| format!(".{port}({port})"));
        let outputs = ports.outputs.iter().map(|(port, _)| format!(".{port}({prefix}{port})"));
        inputs.chain(outputs).collect::<Vec<_>>().join(", ")
    };
    let differ = ports.compared.iter().map(|(port, during)| {
        let during = during.as_ref().map_or(String::new(), |during| format!("{during} && "));
        format!("({during}{port} != other_{port})")
    });
    let differ: Vec<String> = differ.collect();
    format!(
        "module miter({header}, output bad);\n{body}original the_original({});\nfaulty the_faulty({});\n\
         assign bad = started && !rst && ({});\nendmodule\n",
        connections(original, ""),
        connections(faulty, "other_"),
        differ.join(" || ")
    )
}

/// The module `miter` of a watched design; all its inputs are free.
pub fn watch(ports: &Ports, watched: &Netlist) -> String {
    let clock = [(watched.has_clock, "clk"), (watched.has_reset, "rst")];
    let clock = clock.into_iter().filter(|(has, _)| *has).map(|(_, name)| (name, 1));
    let inputs = ports.inputs.iter().map(|(port, width)| (port.as_str(), *width));
    let inputs: Vec<(&str, u32)> = clock.chain(inputs).collect();
    let header: Vec<String> =
        inputs.iter().map(|(port, width)| format!("input [{}:0] {port}", width - 1)).collect();
    let connections: Vec<String> = inputs.iter().map(|(port, _)| format!(".{port}({port})")).collect();
    format!(
        "module miter({}, output bad);\noriginal the_original({}, .{DIFFERS}(bad));\nendmodule\n",
        header.join(", "),
        connections.join(", ")
    )
}
