#include "burin/failure.h"

#include <exception>
#include <new>

namespace burin {
namespace {

struct Failure {
    int kind = BURIN_DONE;
    std::string text;
    const char* fixed_text = nullptr;  // where there is no memory for one
};
thread_local Failure t_failure;

int note(int kind, const char* text) noexcept {
    t_failure.kind = kind;
    t_failure.fixed_text = nullptr;
    try {
        t_failure.text = text;
    } catch (...) {
        t_failure.fixed_text = "out of memory";
    }
    return kind;
}

}  // namespace

int note_failure() noexcept {
    try {
        throw;
    } catch (const UsageError& error) {
        return note(BURIN_BAD_ARGUMENT, error.what());
    } catch (const Interrupted&) {
        return note(BURIN_STOPPED, "stopped, by burin_cancel() or the progress function");
    } catch (const InputError& error) {
        return note(BURIN_BAD_INPUT, error.what());
    } catch (const std::bad_alloc&) {
        t_failure.kind = BURIN_NO_MEMORY;
        t_failure.fixed_text = "out of memory; use a smaller picture, fewer layers or a smaller model";
        return BURIN_NO_MEMORY;
    } catch (const std::exception& error) {
        return note(BURIN_FAILED, error.what());
    } catch (...) {
        return note(BURIN_FAILED, "unknown failure");
    }
}

}  // namespace burin

int burin_abi(void) { return BURIN_ABI; }
const char* burin_version(void) { return BURIN_VERSION; }
const char* burin_error(void) {
    using burin::t_failure;
    return t_failure.fixed_text != nullptr ? t_failure.fixed_text : t_failure.text.c_str();
}
int burin_error_kind(void) { return burin::t_failure.kind; }
