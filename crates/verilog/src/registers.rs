//! A group of registers as one `always` block, shaped the way it was built.

use edgewalk_netlist::netlist::{Netlist, NodeId, Source};
use edgewalk_netlist::ops::Bits;

use crate::expression::Writer;
use crate::groups::Group;
use crate::literal;
use crate::paragraph::{Body, LINE};

impl Group {
    /// The `always` block; what its expressions need is declared in `body` before it.
    pub fn print(&self, writer: &mut Writer, body: &mut Body) {
        let mut lines = vec!["always @(posedge clk) begin".to_string()];
        if self.has_reset {
            lines.push("  if (rst) begin".into());
            lines.extend(self.registers.iter().map(|index| reset(writer.netlist, *index)));
        }
        match (self.has_reset, &self.conditions[..]) {
            (false, _) => {
                (0..self.conditions.len()).for_each(|i| lines.extend(self.update(writer, body, i, 2)))
            }
            (true, [Some(condition)]) => {
                let condition = writer.alone(body, "  end else if (", *condition);
                lines.push(condition + ") begin");
                lines.extend(self.assignments(writer, body, 0, 4));
                lines.push("  end".into());
            }
            (true, _) => {
                lines.push("  end else begin".into());
                (0..self.conditions.len()).for_each(|i| lines.extend(self.update(writer, body, i, 4)));
                lines.push("  end".into());
            }
        }
        lines.push("end".into());
        let lines: Vec<String> = lines.iter().flat_map(|line| line.lines()).map(String::from).collect();
        body.block(&lines);
    }

    /// Update `i` of all registers, under its condition.
    fn update(&self, writer: &mut Writer, body: &mut Body, i: usize, indent: usize) -> Vec<String> {
        let Some(condition) = self.conditions[i] else {
            return self.assignments(writer, body, i, indent);
        };
        let fill = " ".repeat(indent);
        let head = writer.alone(body, &format!("{fill}if ("), condition) + ")";
        let inner = self.assignments(writer, body, i, indent + 2);
        match &inner[..] {
            [only]
                if !only.contains('\n') && !head.contains('\n') && head.len() + only.trim().len() < LINE =>
            {
                vec![format!("{head} {}", only.trim())]
            }
            _ => [vec![format!("{head} begin")], inner, vec![format!("{fill}end")]].concat(),
        }
    }

    fn assignments(&self, writer: &mut Writer, body: &mut Body, i: usize, indent: usize) -> Vec<String> {
        let netlist = writer.netlist;
        let assign = |index: &usize| {
            let register = &netlist.registers[*index];
            let before = format!("{:indent$}{} <= ", "", register.name);
            writer.alone(body, &before, register.updates[i].value) + ";"
        };
        self.registers.iter().map(assign).collect()
    }
}

fn reset(netlist: &Netlist, index: usize) -> String {
    let register = &netlist.registers[index];
    let bits = Bits { value: register.reset.unwrap_or(0), width: netlist.width(register.node) };
    let mut values = register.updates.iter().map(|update| update.value);
    let name = values.find_map(|value| constant_name(netlist, value, bits.value));
    let value = name.map_or_else(|| literal::unsigned(bits), String::from);
    format!("    {} <= {value};", register.name)
}

/// The name of the constant `id` if it is `value`: so a state that is loaded by its name is called by it in reset too.
fn constant_name(netlist: &Netlist, id: NodeId, value: u128) -> Option<&str> {
    match &netlist.node(id).source {
        Source::Constant { value: other, name: Some(name) } if *other == value => Some(name),
        _ => None,
    }
}
