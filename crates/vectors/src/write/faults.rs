//! The words of the test bench for a fault: channel, token, triangle, case, and each field that differs.

use crate::suites::Suite;
use edgewalk_lockstep::Port;
use edgewalk_machine::Scale;
use std::fmt::Write as _;

/// Verilog that tells what a channel's sink found, in full and field by field; `suffix` is that of the wire which holds the
/// token. Where `known`, `<name>.triangle.mem` says, in steps, to which triangle a token belongs.
pub fn telling(name: &str, suffix: &str, fields: &[Port], known: bool) -> String {
    let found = if suffix.is_empty() { name.to_owned() } else { format!("{name}_{suffix}") };
    let noun = if suffix.is_empty() { "change" } else { "token" };
    let upper = name.to_uppercase();
    let mut text = String::new();
    let (triangle, triangle_of) = if known {
        let _ = writeln!(
            text,
            "    reg [31:0] {name}_triangles [0:({upper}_COUNT == 0 ? 0 : {upper}_COUNT - 1)];"
        );
        let _ = writeln!(
            text,
            "    integer {name}_place;
    initial if ({upper}_COUNT > 0) begin
        $readmemh(\"{name}.triangle.mem\", {name}_triangles);
        for ({name}_place = 1; {name}_place < {upper}_COUNT; {name}_place = {name}_place + 1)
            {name}_triangles[{name}_place] = {name}_triangles[{name}_place - 1] + {name}_triangles[{name}_place];
    end"
        );
        let number = format!("{name}_triangles[{name}_checked]");
        (", triangle %0d, case %0s", format!(", {number}, case_name({number})"))
    } else {
        ("", String::new())
    };
    let head = format!("{name}: {noun} %0d{triangle}");
    let arguments = format!("{name}_checked{triangle_of}");
    let _ = write!(
        text,
        r#"    always @(posedge clk) if (compared && {name}_fault != 0 && {name}_wrong < SHOWN) {name}_tell;
    task {name}_tell; begin
        if ({name}_fault == 1)
            $display("{name}: cycle %0d: %h is one more than the %0d expected", cycle, {found}, {upper}_COUNT);
        else if ({name}_fault == 4)
            $display("{head}: expected in cycle %0d, found in cycle %0d", {arguments}, {name}_due, cycle);
        else begin
            if ({name}_fault == 2)
                $display("{head}, cycle %0d: unknown bits: %h", {arguments}, cycle, {found});
            else
                $display("{head}, cycle %0d: expected %h, found %h", {arguments}, cycle, {name}_want, {found});
"#
    );
    let mut high: u32 = fields.iter().map(|field| field.width()).sum();
    for field in fields {
        let bits = format!("[{}:{}]", high - 1, high - field.width());
        high -= field.width();
        let (want, is) = (format!("{name}_want{bits}"), format!("{found}{bits}"));
        let sign = if field.is_signed() { "$signed" } else { "" };
        let shown = |value: &str| match real(field) {
            None => ("%h (%0d)".to_owned(), format!("{value}, {sign}({value})")),
            Some((scale, unit)) => {
                let number = format!("{sign}({value})");
                (format!("%h (%0d, %0.7g{unit})"), format!("{value}, {number}, (1.0 * {number}) / {scale:e}"))
            }
        };
        let ((form, wanted), (_, found)) = (shown(&want), shown(&is));
        let _ = writeln!(
            text,
            "            if ({is} !== {want})\n                $display(\"    {}: expected {form}, found {form}\", {wanted}, {found});",
            field.name
        );
    }
    let _ = write!(
        text,
        r#"        end
    end endtask
    task {name}_missing; begin
        $display("{head} never came, the first of %0d; %0d were expected", {arguments}, {upper}_COUNT - {name}_checked, {upper}_COUNT);
    end endtask
"#
    );
    text
}

/// How the real value of a field follows from its number: what to divide by, and the unit; `None` where the number is the
/// value, and where it is too long for the simulators' conversion.
fn real(field: &Port) -> Option<(f64, String)> {
    let format = field.field.format;
    if field.width() > 64 {
        return None;
    }
    match field.field.scale {
        Scale::Count => None,
        Scale::Unorm => Some((format.max_raw() as f64, String::new())),
        Scale::Of(unit) | Scale::Modular(unit) => {
            Some((f64::from(format.fraction_bits()).exp2(), format!(" {unit}").trim_end().to_owned()))
        }
    }
}

/// `cases.vh`: the name of the case that a triangle belongs to, as a function.
pub fn cases(suite: &Suite) -> String {
    let longest = suite.cases.iter().map(|case| case.name.len()).max().unwrap_or(1).max(1);
    let mut text = format!(
        "// The case that a triangle belongs to.\nfunction [{}:0] case_name;\n    input [31:0] triangle;\n    begin\n        case_name = 0;\n",
        8 * longest - 1
    );
    let mut first = 0;
    for case in suite.cases.iter().filter(|case| !case.triangles.is_empty()) {
        let condition = if first == 0 { String::new() } else { format!("if (triangle >= {first}) ") };
        let _ = writeln!(text, "        {condition}case_name = \"{}\";", plain(&case.name));
        first += case.triangles.len();
    }
    text.push_str("    end\nendfunction\n");
    text
}

/// Names of cases can come from files' names: nothing in them may end a string of Verilog.
fn plain(name: &str) -> String {
    name.chars().map(|c| if c.is_ascii_graphic() && c != '"' && c != '\\' { c } else { '_' }).collect()
}
