/// A fault: what it is, the file of the model, a text that stands there once, and what it becomes.
type Mutant = (&'static str, &'static str, &'static str, &'static str);

/// The faults; the first changes nothing and must not be found.
pub const MUTANTS: &[Mutant] = &[
    ("no fault", "depth.rs", "", ""),
    // The z bypass.
    ("z bypass from the write removed", "depth.rs", "written.then_some(self.w.z)", "None"),
    ("z bypass from the compare removed", "depth.rs", "if self.forwards && pass &&", "if false &&"),
    ("the bypassed depth is not used", "depth.rs", "forward.unwrap_or(data)", "data"),
    // Hazards and handshakes.
    (
        "drain does not wait for the write",
        "depth.rs",
        "self.queue.len() > 0 || self.w_valid",
        "self.queue.len() > 0",
    ),
    (
        "interlock does not wait for the write",
        "depth.rs",
        "|| self.w_valid && self.w.z_en && self.w.addr == frag.addr",
        "",
    ),
    (
        "the queue is full one too early",
        "depth.rs",
        "self.queue.len() == self.depth",
        "self.queue.len() + 1 == self.depth",
    ),
    ("a depth is taken only without a write", "depth.rs", "(!self.w_valid || wr_ready)", "!self.w_valid"),
    (
        "the pipeline needs ready without a fragment",
        "pixel.rs",
        "self.frag().is_none() || frag_ready",
        "frag_ready",
    ),
    (
        "a span ends one pixel early",
        "pixel.rs",
        "self.phase == self.last_phase && self.count == 1",
        "self.count <= 2",
    ),
    ("a prim does not wait for the gradients", "edge.rs", "!self.running && !fresh_queued", "!self.running"),
    ("flags of dropped lines are lost", "span.rs", "line.fresh | self.pend_fresh", "line.fresh"),
    ("no fence at the knee", "edge.rs", "self.line.fence = knee && self.textbook", "self.line.fence = false"),
    // Rounding.
    ("quotients are cut, not rounded", "setup/mod.rs", "(n + d / 2).div_euclid(d)", "n.div_euclid(d)"),
    ("first values without half an LSB", "setup/channels.rs", "(1i128 << c.fraction) >> 1", "0"),
    ("first lines rounded down", "setup/edges.rs", "-(-v >> t)", "v >> t"),
    ("textbook columns without +0.5", "setup/edges.rs", "i64::from(machine.fill == Fill::Textbook)", "0"),
    // Comparisons and signs.
    ("equal depths count as less", "depth.rs", "fragment.z >= old", "fragment.z > old"),
    ("an edge carries at equality too", "tokens.rs", "self.r < self.f", "self.r <= self.f"),
    (
        "a span of no columns is drawn",
        "span.rs",
        "end.min(self.width) <= start.max(0)",
        "end.min(self.width) < start.max(0)",
    ),
    (
        "a column right of the screen is drawn",
        "pixel.rs",
        "(self.x as u32) < self.width",
        "(self.x as u32) <= self.width",
    ),
    ("the gradient's sign on the wrong side", "setup/channels.rs", "if prim.left {", "if !prim.left {"),
    ("equal tops sorted by column", "setup/sort.rs", "sort_by_key(|c| c.v)", "sort_by_key(|c| (c.v, c.u))"),
    // Constants.
    ("a product takes a clock less", "setup/clocks.rs", "1 + d.div_ceil(k)", "d.div_ceil(k)"),
    (
        "the step of a knee line is that of the upper edge",
        "edge.rs",
        "self.minor = self.held.minor[1]",
        "self.minor.step(self.column_bits)",
    ),
];
