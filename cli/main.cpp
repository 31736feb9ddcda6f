#include <cxxabi.h>
#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <new>
#include <string_view>
#include <typeinfo>

#include "base/atomic_file.h"
#include "base/error.h"
#include "base/heap.h"
#include "base/instruction_set.h"
#include "base/interrupt.h"
#include "base/mapped_file.h"
#include "cli/arguments.h"
#include "cli/commands.h"
#include "mesh/text_scan.h"

namespace {

enum ExitStatus { kDone = 0, kFailed = 1, kWrongUsage = 2, kInterrupted = 130 };

constexpr std::string_view kOutOfMemory =
    "burin: out of memory; use a smaller --size, fewer --layers or a smaller model\n";

/// Destructors of libraries take memory: where there is none, they end the program.
[[noreturn]] void end_without_memory() {
    const std::type_info* const type = abi::__cxa_current_exception_type();
    if (type == nullptr || *type != typeid(std::bad_alloc)) std::abort();
    [[maybe_unused]] const ssize_t written = ::write(STDERR_FILENO, kOutOfMemory.data(), kOutOfMemory.size());
    burin::remove_temporary_files();
    ::_exit(kFailed);
}

/// A file must not get the number of a standard stream that is closed: messages would end up in it.
void open_missing_standard_streams() {
    for (const int fd : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO}) {
        if (::fcntl(fd, F_GETFD) >= 0 || errno != EBADF) continue;
        const int opened = ::open("/dev/null", O_RDWR);  // takes the lowest free number: fd
        if (opened >= 0 && opened != fd) ::close(opened);
    }
}

/// Names in messages come from files and may hold line feeds; every message stays on one line.
void print_error(const char* prefix, const char* message) {
    std::fprintf(stderr, "%s%s\n", prefix, burin::printable(message, 4000).c_str());
}

void run(const burin::Arguments& arguments) {
    switch (arguments.command) {
        case burin::Command::render:
            if (arguments.memory_bytes == 0) burin::keep_freed_memory(arguments.threads);
            return run_render(arguments);
        case burin::Command::info:
            return run_info(arguments);
        case burin::Command::explain:
            return run_explain(arguments);
        case burin::Command::methods:
            return run_methods(arguments);
        case burin::Command::styles:
            return run_styles(arguments);
        case burin::Command::restyle:
            return run_restyle(arguments);
        case burin::Command::compare:
            return run_compare(arguments);
        case burin::Command::assemble:
            return run_assemble(arguments);
        case burin::Command::submit:
            return run_submit(arguments);
        case burin::Command::view:
            return run_view(arguments);
    }
}

/// Commands that only print end without a word when their reader goes away, as other programs do. The others have a
/// file to finish.
bool only_prints(const burin::Arguments& arguments) {
    switch (arguments.command) {
        case burin::Command::info:
        case burin::Command::explain:
        case burin::Command::methods:
        case burin::Command::styles:
            return true;
        case burin::Command::render:
        case burin::Command::submit:
            return arguments.is_dry_run;
        case burin::Command::restyle:
        case burin::Command::compare:
        case burin::Command::assemble:
        case burin::Command::view:
            return false;
    }
    return false;
}

/// What was printed must have arrived.
void check_standard_output() {
    if (std::fflush(stdout) != 0 || std::ferror(stdout) != 0) {
        throw burin::InputError("standard output: cannot write; is the disk full, or the reader gone?");
    }
}

}  // namespace

int main(int argc, char** argv) {
    open_missing_standard_streams();
    // Files beyond a limit, and closed pipes where there are files, show as errors of the writes, so that nothing is
    // left lying around.
    std::signal(SIGXFSZ, SIG_IGN);
    burin::install_interrupt_handlers();
    burin::MappedFile::end_process_where_files_are_cut();
    std::set_terminate(end_without_memory);
    try {
        burin::check_instruction_set();
        if (const auto arguments = burin::parse_arguments(argc, argv)) {
            if (!only_prints(*arguments)) std::signal(SIGPIPE, SIG_IGN);
            run(*arguments);
        }
        check_standard_output();
        return kDone;
    } catch (const burin::UsageError& error) {
        print_error("burin: ", error.what());
        return kWrongUsage;
    } catch (const burin::Interrupted& interrupted) {
        print_error("burin: ", interrupted.what());
        std::fflush(stdout);
        burin::remove_temporary_files();
        ::_exit(kInterrupted);  // a thread may still load a module, and the end of a program would wait for it
    } catch (const burin::InputError& error) {
        print_error("", error.what());
        return kFailed;
    } catch (const std::bad_alloc&) {
        std::fputs(kOutOfMemory.data(), stderr);
        return kFailed;
    } catch (const std::exception& error) {
        print_error("burin: unexpected failure, please report it: ", error.what());
        return kFailed;
    }
}
