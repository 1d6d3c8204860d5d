//! How memory is taken from the system.

/// Has the C library take memory for its heaps by 64 MiB of addresses at a time (pages that are never touched cost
/// nothing), and blocks of up to 32 MiB from there. Else every thread's heap grows by a page or two per call, thousands
/// of times, each of which stops the other threads, and larger blocks are given back and taken anew, zeroed each time.
pub fn take_in_bulk() {
    #[cfg(all(target_os = "linux", target_env = "gnu", target_pointer_width = "64"))]
    {
        let set = |parameter, bytes| {
            // SAFETY: the call only sets a number, under the allocator's own lock.
            #[allow(unsafe_code)]
            let done = unsafe { libc::mallopt(parameter, bytes) };
            debug_assert_eq!(done, 1, "mallopt({parameter}, {bytes})");
        };
        set(libc::M_TOP_PAD, 64 << 20);
        set(libc::M_MMAP_THRESHOLD, 32 << 20);
    }
}
