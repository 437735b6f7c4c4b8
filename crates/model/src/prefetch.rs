//! Asks the host for a word before it is needed. Not hardware, and nothing a program could see but its time.

/// Brings the cache line of `memory[place]` near, where the processor knows how; a place behind the end asks for nothing
/// of use.
#[inline(always)]
pub fn prefetch<T>(memory: &[T], place: usize) {
    #[cfg(target_arch = "x86_64")]
    {
        use std::arch::x86_64::{_MM_HINT_T0, _mm_prefetch};
        // SAFETY: a prefetch is a hint: it reads and writes nothing a program can see and cannot fault, whatever the
        // address; `wrapping_add` may form one behind the end.
        unsafe { _mm_prefetch::<_MM_HINT_T0>(memory.as_ptr().wrapping_add(place).cast()) };
    }
    #[cfg(not(target_arch = "x86_64"))]
    let _ = (memory, place);
}
