#pragma once

// The program's heap keeps what is freed, in huge pages, because the first write to fresh memory costs more than most
// work on it.

namespace burin {

/// Makes the heap keep what the program frees, to be used again, and take memory in huge pages: for a program that soon
/// needs much memory, again and again. The first write to fresh memory costs more than most work on it. Not for
/// programs that are to stay below a limit, for holes between what is in use are kept, too.
///
/// Of the program's `threads` (0: one per core) four share a heap: what one frees another can use.
void keep_freed_memory(int threads) noexcept;

}  // namespace burin
