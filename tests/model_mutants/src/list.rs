/// A fault: what it is, the file of the model, a text that stands there once, and what it becomes.
type Mutant = (&'static str, &'static str, &'static str, &'static str);

/// The faults; the first changes nothing and must not be found.
pub const MUTANTS: &[Mutant] = &[
    ("no fault", "rmw.rs", "", ""),
    // The z bypass.
    ("z bypass from the write removed", "rmw.rs", "self.forwards && self.w_stores(addr)", "false"),
    ("z bypass from the compare removed", "rmw.rs", "if self.forwards && self.w_valid &&", "if false &&"),
    ("the bypassed depth is not used", "rmw.rs", "if forwarded { self.forward[slot] } else { data }", "data"),
    // Hazards and handshakes.
    ("drain does not wait for the write", "rmw.rs", "self.len > 0 || self.w_valid", "self.len > 0"),
    (
        "interlock does not wait for the write",
        "rmw.rs",
        "(self.holds(addr) || self.w_stores(addr))",
        "self.holds(addr)",
    ),
    ("the queue is full one too early", "rmw.rs", "self.len == self.depth", "self.len + 1 == self.depth"),
    ("a depth is taken only without a write", "rmw.rs", "(!self.w_valid || wr_ready)", "!self.w_valid"),
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
    ("flags of dropped lines are lost", "span.rs", "let fresh = line.fresh | self.pend_fresh", "let fresh = line.fresh"),
    ("no fence at the knee", "edge.rs", "self.line.fence = knee && self.textbook", "self.line.fence = false"),
    // Rounding.
    ("quotients are cut, not rounded", "setup/mod.rs", "(n + d / 2).div_euclid(d)", "n.div_euclid(d)"),
    ("first values without half an LSB", "setup/channels.rs", "(1i128 << channel.fraction) >> 1", "0"),
    ("first lines rounded down", "setup/edges.rs", "-(-v >> t)", "v >> t"),
    ("textbook columns without +0.5", "setup/edges.rs", "i64::from(plan.fill == Fill::Textbook)", "0"),
    // Comparisons and signs.
    ("equal depths count as less", "depth.rs", "u8::from(z >= old)", "u8::from(z > old)"),
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
        "(self.x as u32) < self.pass.width",
        "(self.x as u32) <= self.pass.width",
    ),
    (
        "the gradient's sign on the wrong side",
        "setup/channels.rs",
        "if prim.major_right {",
        "if !prim.major_right {",
    ),
    ("equal tops sorted by column", "setup/sort.rs", "sort_by_key(|c| c.v)", "sort_by_key(|c| (c.v, c.u))"),
    // Channels of the user's own.
    ("floor channels carry half an LSB", "setup/channels.rs", "if channel.kind.is_rounded()", "if true"),
    (
        "vertices of signed channels read without sign",
        "setup/sort.rs",
        "if channel.kind.is_signed()",
        "if false",
    ),
    ("outputs of signed channels read without sign", "tokens.rs", "if channel.kind.is_signed()", "if false"),
    ("the last output is not cut to its bits", "pixel.rs", "u32::MAX >> (32 - c.bits)", "u32::MAX"),
    (
        "turns of the lanes rounded down",
        "setup/clocks.rs",
        "plan.channels().chunks(lanes)",
        "plan.channels().chunks_exact(lanes)",
    ),
    (
        "the user's channels are not stored",
        "memory.rs",
        "self.own[at] = std::array::from_fn(|i| values[FEW + i]);",
        "",
    ),
    // Constants.
    ("lanes are a clock less behind", "setup/clocks.rs", "BEHIND: u32 = 4", "BEHIND: u32 = 3"),
    ("a number equal to the modulus fits", "setup/clocks.rs", "d < m", "d <= m"),
    (
        "the step of a knee line is that of the upper edge",
        "edge.rs",
        "self.minor = self.held.minor[1]",
        "self.minor.step(self.column_bits)",
    ),
];
