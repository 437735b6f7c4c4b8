//! Memories as arrays, the way synthesis tools recognise a block RAM.

use edgewalk_netlist::netlist::Memory;
use edgewalk_netlist::ops::Bits;

use crate::expression::Writer;
use crate::literal;
use crate::paragraph::Body;

/// The array, and its first contents if it has any.
pub(crate) fn declare(writer: &mut Writer, body: &mut Body, memory: &Memory) {
    let Memory { name, doc, words, width, init, .. } = memory;
    body.line(format!("reg {}{name} [0:{}];", literal::range(*width), words - 1), doc);
    let Some(init) = *init else { return };
    let block = writer.names.fresh(&format!("{name}_init"));
    let index = writer.names.fresh(&format!("{name}_index"));
    let init = literal::unsigned(Bits { value: init, width: *width });
    body.block(&[
        format!("initial begin : {block}"),
        format!("  integer {index};"),
        format!("  for ({index} = 0; {index} < {words}; {index} = {index} + 1) {name}[{index}] = {init};"),
        "end".into(),
    ]);
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
