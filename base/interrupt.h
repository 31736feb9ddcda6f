#pragma once

// Signals that ask the program to stop become an exception that long loops throw, so that no partial file is left.

namespace burin {

/// From now on SIGINT, SIGTERM, SIGHUP (the terminal is gone), SIGQUIT and SIGXCPU (a limit of CPU time) ask the
/// program to stop instead of killing it. The same signal again kills at once, but for SIGXCPU. A SIGHUP that is
/// ignored stays so.
void install_interrupt_handlers();

/// True once one of the signals has arrived.
bool interrupt_requested() noexcept;

/// Throws `Interrupted` once one of the signals has arrived. Long loops call this now and then.
void throw_if_interrupted();

}  // namespace burin
