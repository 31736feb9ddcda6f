#pragma once

namespace burin {

/// From now on SIGINT and SIGTERM ask the program to stop instead of killing it.
/// A second signal kills at once.
void install_interrupt_handlers();

/// True once one of the signals has arrived.
bool interrupt_requested() noexcept;

/// Throws `Interrupted` once one of the signals has arrived. Long loops call this now and then.
void throw_if_interrupted();

}  // namespace burin
