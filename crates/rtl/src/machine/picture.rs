//! The machine in the header of its Verilog, drawn from what the units declare.

use edgewalk_machine::Ports;

/// Units in a row with their links; under them, in as many rows as it takes, held values from unit to unit and memories.
pub(super) fn picture(units: &[(&str, Ports)]) -> String {
    let mut row = String::from(" ");
    let mut middles = Vec::new();
    for (place, (name, ports)) in units.iter().enumerate() {
        match &ports.takes {
            Some(link) if place == 0 => row += &format!("{} ─> ", link.name),
            _ => {}
        }
        middles.push(row.chars().count() + name.len() / 2);
        row += &name.to_uppercase();
        row += &ports.gives.as_ref().map_or_else(String::new, |link| format!(" ─{}─> ", link.name));
    }
    // What the last unit writes is read too, if it is a memory's word: then it is called by that.
    let last = units.last().and_then(|(_, ports)| ports.memory.iter().find(|memory| memory.enable.is_none()));
    row += &last.map_or_else(|| "frame memory".to_owned(), |memory| format!("{} memory", memory.name));

    let mut below: Vec<Vec<char>> = Vec::new();
    for (place, (_, ports)) in units.iter().enumerate() {
        for held in &ports.held_in {
            let holds = |(_, giver): &(&str, Ports)| giver.held_out.iter().any(|out| out.name == held.name);
            let Some(giver) = units.iter().position(holds) else { continue };
            let (from, to) = (middles[giver].min(middles[place]), middles[giver].max(middles[place]));
            let arc = format!("└{:─^1$}┘", format!(" {} ", held.name), to - from - 1);
            put(&mut below, from, &arc);
        }
        for memory in &ports.memory {
            let writes = ports.writes.iter().find(|link| link.name == memory.write);
            let writes = writes.map_or_else(String::new, |link| format!(", {}", link.name));
            let (read, data) = (memory.read.name, memory.data.name);
            let line = format!("└─{read} / {data}{writes}─ {} memory", memory.name);
            put(&mut below, middles[place], &line);
        }
    }
    below.iter().fold(row, |text, line| text + "\n" + line.iter().collect::<String>().trim_end())
}

/// Into the first row that is free there.
fn put(rows: &mut Vec<Vec<char>>, column: usize, text: &str) {
    let row = rows.iter_mut().find(|row| row.len() < column);
    let row = match row {
        Some(row) => row,
        None => {
            rows.push(Vec::new());
            let last = rows.len() - 1;
            &mut rows[last]
        }
    };
    row.resize(column, ' ');
    row.extend(text.chars());
}
