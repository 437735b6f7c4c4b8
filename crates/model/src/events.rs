//! Which events a run has met, those that the units declare (`edgewalk_machine::UNITS`). A suite that leaves one at zero has not tested it.

macro_rules! events {
    ($($(#[$doc:meta])* $name:ident,)*) => {
        /// How often each event was met.
        #[derive(Clone, Debug, Default, PartialEq, Eq)]
        pub struct Events { $($(#[$doc])* pub $name: u64,)* }

        impl Events {
            /// Every name with its count.
            #[must_use]
            pub fn counts(&self) -> Vec<(&'static str, u64)> {
                vec![$((stringify!($name), self.$name)),*]
            }

            /// Adds the counts of another run.
            pub fn merge(&mut self, other: &Events) {
                $(self.$name += other.$name;)*
            }
        }
    };
}

events! {
    /// Triangles without a line on the screen.
    culled_lines,
    /// Triangles with lines, but without a column on the screen.
    culled_columns,
    /// Triangles with lines and columns, but without area.
    culled_area,
    /// Triangles whose major edge lies left.
    major_left,
    /// Triangles whose major edge lies right.
    major_right,
    /// Triangles without an upper part on the screen, n1 = 0.
    no_upper_part,
    /// Triangles without a lower part on the screen, n2 = 0.
    no_lower_part,
    /// Triangles of two parts whose knee lies on a line of pixel centres.
    knee_on_line,
    /// Triangles taken in while PIXEL draws.
    setup_overlap,
    /// Steps of the major edge with a carry.
    carry,
    /// Steps of the major edge without a carry.
    no_carry,
    /// Steps of an edge value that leave the range of its word.
    wrap,
    /// Lines without a pixel.
    empty_span,
    /// Lines without a pixel that passed on the mark of a triangle's first line.
    dropped_fresh,
    /// Cycles in which a line waits for the span FIFO.
    span_fifo_full,
    /// Cycles in which a triangle waits until the first span of the one before is taken.
    fresh_wait,
    /// Spans cut by the screen at the side where they end.
    scissor_cut,
    /// Pixels stepped over off the screen.
    off_screen,
    /// Fragments that carry a fence.
    fence,
    /// Cycles in which DEPTH waits at a fence (drain).
    drain_stall,
    /// Cycles in which DEPTH waits for an address in flight (interlock).
    interlock_stall,
    /// Cycles in which a fragment waits for the in-flight queue.
    queue_full,
    /// Cycles in which a read waits for the memory.
    memory_stall,
    /// Cycles in which a write waits for the memory.
    write_stall,
    /// Fragments in the queue, or entering it, that took their old depth from a compare.
    forward_compare,
    /// Fragments entering the queue that took it from the write register.
    forward_write,
    /// Compares that used a forwarded depth.
    forward_used,
    /// Fragments that failed the compare.
    depth_fail,
    /// Records that were read.
    record_read,
    /// Steps of TERM's walk to the next line.
    walk_down,
    /// Steps of the walk towards the end of a span.
    walk_forward,
    /// Steps of the walk away from the end of a span.
    walk_back,
    /// Cycles in which the walk stands at a span that PIXEL does not take yet.
    walk_waits,
    /// Cycles in which a span waits for the last result of the walk alone (memory).
    walk_result_last,
    /// Cycles in which a read waits for the memory of the terms.
    term_read_stall,
    /// Texels that were read.
    texel_read,
    /// Cycles in which a read waits for the memory of the textures.
    texel_read_stall,
    /// Cycles in which a fragment waits for TEXEL's queue.
    texel_queue_full,
    /// Cycles in which the oldest fragment waits for its texel.
    texel_data_wait,
    /// Cosines that the relief makes larger.
    slope_up,
    /// Cosines that the relief makes smaller.
    slope_down,
    /// Slopes of the lowest number that there is.
    slope_lowest,
    /// Cosines cut at the end of their bits.
    bump_cut,
    /// N·N cut at the end of its bits.
    square_cut,
    /// Cycles in which all stages of BUMP stand still.
    bump_stall,
    /// Times that NORMAL's roots were fetched.
    roots_read,
    /// Cycles in which a read waits for the roots.
    root_read_stall,
    /// Normals shorter than half.
    normal_short,
    /// Normals of length 1, or longer.
    normal_long,
    /// Cosines beyond what SHADE takes.
    cosine_cut,
    /// Cycles in which all stages of NORMAL stand still.
    normal_stall,
    /// Times that LAMP fetched its tables.
    lamp_read,
    /// Cycles in which a read of LAMP waits for them.
    lamp_read_stall,
    /// Fragments less than half as far from the light as the unit of the ways.
    lamp_near,
    /// Fragments outside the light's cone.
    lamp_beside,
    /// Roots of less than the tables of LAMP reach down to.
    lamp_short,
    /// Numbers of LAMP cut at the end of their bits.
    lamp_cut,
    /// Cycles in which a fragment waits until another is done in LAMP.
    lamp_wait,
    /// Cycles in which a fragment that is done waits in LAMP.
    lamp_stall,
    /// Materials whose tables were fetched.
    tables_read,
    /// Materials that another one took the place of.
    material_change,
    /// Cycles in which new tables wait for fragments of the old ones.
    tables_drain,
    /// Cycles in which a read waits for the memory of the tables.
    table_read_stall,
    /// Cosines N·L below 0, a light a fragment.
    diffuse_below,
    /// Cosines N·L beyond the table's end.
    diffuse_above,
    /// Cosines N·H before the table's beginning.
    highlight_below,
    /// Cosines N·H beyond the table's end.
    highlight_above,
    /// Highlights that are dropped, as the light is below the horizon.
    highlight_unlit,
    /// Colours cut to the largest.
    color_saturated,
    /// Cycles in which all stages of SHADE stand still.
    shade_stall,
    /// Fragments behind the light, or beside it.
    behind_light,
    /// Columns and lines on the far edge of the map.
    map_edge,
    /// Columns and lines on the edge of a texel.
    texel_edge,
    /// Depths before the map's end that are rounded to it.
    depth_to_end,
    /// Cycles in which all stages of PROJECT stand still.
    project_stall,
    /// Cycles in which a fragment waits until another is divided.
    project_wait,
    /// Fragments that were not looked up, as the map does not count.
    shadow_off,
    /// Fragments of the light's own pass: none is looked up.
    own_map,
    /// Fragments outside the map: lit.
    outside_map,
    /// Fragments nearer to the light than the map begins: lit.
    before_map,
    /// Fragments farther from the light than the map ends: in shadow.
    behind_map,
    /// Fragments that their texel finds lit.
    texel_lit,
    /// Fragments that their texel finds in shadow.
    texel_shadow,
    /// Fragments exactly as far as their texel: lit.
    texel_tie,
    /// Fragments that their texel finds lit through what transmits: not all of the light is left.
    texel_glass,
    /// Cycles in which a fragment could go on but for its texel.
    texel_wait,
    /// Cycles in which a fragment waits for SHADOW's queue.
    shadow_queue_full,
    /// Cycles in which a read waits for the map.
    map_stall,
    /// Fragments that need no texel and come behind one that waits for its own.
    known_behind_read,
    /// Depths written before BLEND took the colour.
    depth_first,
    /// Colours that BLEND took before the depth was written.
    color_first,
    /// Cycles in which a depth alone keeps the write register.
    depth_write_waits,
    /// Fragments that took over the fence of one that failed.
    fence_handed_on,
    /// Fragments that take no colour from their pixel, so that none is read.
    opaque,
    /// Such fragments while one that does take one of the same pixel is in flight.
    opaque_behind,
    /// Fragments that take a colour from one in flight that took none.
    behind_opaque,
    /// Cycles in which BLEND waits at a fence (drain).
    color_drain_stall,
    /// Cycles in which BLEND waits for an address in flight (interlock).
    color_interlock_stall,
    /// Cycles in which a fragment waits for BLEND's queue.
    color_queue_full,
    /// Cycles in which a read waits for the colour memory.
    color_read_stall,
    /// Cycles in which a write waits for the colour memory.
    color_write_stall,
    /// Cycles in which the oldest fragment waits for a result of its pixel.
    color_head_wait,
    /// Fragments in the queue that took the colour from a result.
    color_forward_queue,
    /// Fragments entering the queue that took it from a result of the same cycle.
    color_forward_entry,
    /// Fragments entering the queue that took it from the write register.
    color_forward_write,
    /// Fragments blended with a colour that was forwarded.
    color_forward_used,
}

/// Counts what may happen in every cycle: nobody waits for 2^64, so nothing is checked.
#[inline]
pub(crate) fn one_more(counter: &mut u64) {
    *counter = counter.wrapping_add(1);
}

impl Events {
    /// The names that stand at zero.
    #[must_use]
    pub fn missing(&self) -> Vec<&'static str> {
        self.counts().into_iter().filter(|(_, count)| *count == 0).map(|(name, _)| name).collect()
    }
}
