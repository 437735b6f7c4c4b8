//! Memories as arrays, the way synthesis tools recognise a block RAM or a ROM.

use edgewalk_netlist::netlist::{Contents, Memory, Row};
use edgewalk_netlist::ops::Bits;

use crate::expression::Writer;
use crate::literal;
use crate::paragraph::{Body, commented};

/// The array, and its first contents as far as they are known.
pub(crate) fn declare(writer: &mut Writer, body: &mut Body, memory: &Memory) {
    let Memory { name, doc, words, width, contents: Contents { others, rows }, .. } = memory;
    body.line(format!("reg {}{name} [0:{}];", literal::range(*width), words - 1), doc);
    if others.is_none() && rows.is_empty() {
        return;
    }
    let word = |value| literal::unsigned(Bits { value, width: *width });
    let mut lines = vec![format!("initial begin : {}", writer.names.fresh(&format!("{name}_init")))];
    if let Some(init) = others {
        let (index, init) = (writer.names.fresh(&format!("{name}_index")), word(*init));
        lines.push(format!("  integer {index};"));
        lines.push(format!(
            "  for ({index} = 0; {index} < {words}; {index} = {index} + 1) {name}[{index}] = {init};"
        ));
    }
    let row = |(address, row): (&usize, &Row)| {
        (format!("  {name}[{address}] = {};", word(row.word)), row.doc.replace('\n', " "))
    };
    lines.extend(commented(&rows.iter().map(row).collect::<Vec<_>>()));
    lines.push("end".into());
    body.block(&lines);
}

/// All write ports in one block: of two writes to one word the later stands last.
pub(crate) fn writes(writer: &mut Writer, body: &mut Body, memory: &Memory) {
    let mut lines = vec!["always @(posedge clk) begin".to_string()];
    for port in &memory.writes {
        let en = writer.alone(body, "", port.en);
        let addr = writer.alone(body, "", port.addr);
        let data = writer.alone(body, "", port.data);
        lines.push(format!("  if ({en}) {}[{addr}] <= {data};", memory.name));
    }
    lines.push("end".into());
    body.block(&lines);
}

/// A read port with its registered output.
pub(crate) fn read(writer: &mut Writer, body: &mut Body, memory: &Memory, port: usize, declare: bool) {
    let port = &memory.reads[port];
    if declare {
        body.line(format!("reg {}{};", literal::range(memory.width), port.name), "");
    }
    let en = writer.alone(body, "", port.en);
    let addr = writer.alone(body, "", port.addr);
    body.block(&[
        "always @(posedge clk) begin".into(),
        format!("  if ({en}) {} <= {}[{addr}];", port.name, memory.name),
        "end".into(),
    ]);
}
