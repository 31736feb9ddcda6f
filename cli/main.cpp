#include <cstdio>
#include <exception>
#include <new>

#include "base/error.h"
#include "base/interrupt.h"
#include "cli/arguments.h"
#include "cli/commands.h"

namespace {

enum ExitStatus { kDone = 0, kFailed = 1, kWrongUsage = 2, kInterrupted = 130 };

void run(const burin::Arguments& arguments) {
    switch (arguments.command) {
        case burin::Command::render: return run_render(arguments);
        case burin::Command::info: return run_info(arguments);
        case burin::Command::explain: return run_explain(arguments);
        case burin::Command::methods: return run_methods(arguments);
    }
}

}  // namespace

int main(int argc, char** argv) {
    burin::install_interrupt_handlers();
    try {
        if (const auto arguments = burin::parse_arguments(argc, argv)) run(*arguments);
        return kDone;
    } catch (const burin::UsageError& error) {
        std::fprintf(stderr, "burin: %s\n", error.what());
        return kWrongUsage;
    } catch (const burin::Interrupted&) {
        std::fputs("burin: interrupted; no file was written\n", stderr);
        return kInterrupted;
    } catch (const burin::InputError& error) {
        std::fprintf(stderr, "%s\n", error.what());
        return kFailed;
    } catch (const std::bad_alloc&) {
        std::fputs("burin: out of memory; use a smaller --size, fewer --layers or a smaller model\n", stderr);
        return kFailed;
    } catch (const std::exception& error) {
        std::fprintf(stderr, "burin: unexpected failure: %s; please report this\n", error.what());
        return kFailed;
    }
}
