#pragma once

#include <exception>
#include <new>
#include <string>

#include "base/error.h"
#include "base/interrupt.h"

namespace burin {

/// Runs what writes to `path`; what it throws becomes an InputError that names the file.
template <typename Work>
void naming_file(const std::string& path, const Work& work) {
    try {
        work();
    } catch (const InputError&) {
        throw;
    } catch (const Interrupted&) {
        throw;
    } catch (const std::bad_alloc&) {
        throw;
    } catch (const std::exception& error) {
        throw InputError(path + ": cannot write: " + error.what());
    }
}

}  // namespace burin
