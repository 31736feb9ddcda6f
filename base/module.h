#pragma once

// Libraries that few pictures need lie in modules, which are loaded at their first use.

namespace burin {

/// A function of a module: a shared object that stands beside the program or the shared library that asks for it, or
/// where it was installed with it, and is loaded at its first use. Throws InputError "cannot load MODULE, which
/// PURPOSE: ...; keep it beside the burin program, or REMEDY", or Interrupted where this thread is asked to stop before
/// it is loaded.
void* module_function(const char* module, const char* name, const char* purpose, const char* remedy);

}  // namespace burin
