//! The allocator of the compiled module: the system's, which is asked for large pages where much memory is wanted.
//!
//! A step among a million balls reads and writes some twenty arrays at once, and spends a fifth of its time on looking
//! up where their pages of 4 kB are. Linux gives pages of 2 MB to whoever asks (`madvise`, the default of most systems);
//! what it answers is nobody's business but time's.

use std::alloc::{GlobalAlloc, Layout, System};

/// Less memory than this has too few large pages in it to be worth a call.
const MUCH: usize = 4 << 20;

pub struct LargePages;

// SAFETY: every call goes to the system's allocator unchanged. What `advise` does to memory changes neither its place nor
// its contents.
unsafe impl GlobalAlloc for LargePages {
    unsafe fn alloc(&self, layout: Layout) -> *mut u8 {
        // SAFETY: the caller's promises are those that the system's allocator asks for.
        let memory = unsafe { System.alloc(layout) };
        advise(memory, layout.size());
        memory
    }

    unsafe fn alloc_zeroed(&self, layout: Layout) -> *mut u8 {
        // SAFETY: as above.
        let memory = unsafe { System.alloc_zeroed(layout) };
        advise(memory, layout.size());
        memory
    }

    unsafe fn realloc(&self, memory: *mut u8, layout: Layout, size: usize) -> *mut u8 {
        // SAFETY: as above; `memory` came from the system's allocator, with this layout.
        let memory = unsafe { System.realloc(memory, layout, size) };
        advise(memory, size);
        memory
    }

    unsafe fn dealloc(&self, memory: *mut u8, layout: Layout) {
        // SAFETY: as above; `memory` came from the system's allocator, with this layout.
        unsafe { System.dealloc(memory, layout) }
    }
}

/// Asks for large pages in this memory, which may be null.
#[cfg(target_os = "linux")]
fn advise(memory: *mut u8, size: usize) {
    /// The largest of the pages that Linux is built with; smaller ones begin there as well.
    const PAGE: usize = 64 << 10;
    if size < MUCH || memory.is_null() {
        return;
    }
    let before = memory.align_offset(PAGE);
    let whole = (size - before) / PAGE * PAGE;
    // SAFETY: these pages lie within the memory just given. The advice neither moves nor changes them, and a refusal means
    // only that they stay small.
    unsafe {
        libc::madvise(memory.add(before).cast(), whole, libc::MADV_HUGEPAGE);
    }
}

#[cfg(not(target_os = "linux"))]
fn advise(_: *mut u8, _: usize) {
    _ = MUCH;
}
