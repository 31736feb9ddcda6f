#include <fcntl.h>
#include <spawn.h>
#include <unistd.h>

#include <cstdio>
#include <cstdlib>
#include <string>

#include "base/error.h"
#include "base/heap.h"
#include "cli/commands.h"
#include "mesh/text_scan.h"
#include "web/view_server.h"

namespace burin {
namespace {

/// Has the desktop show a page in the user's browser, if there is a desktop. What that prints is nobody's concern here.
/// False if there is nothing that could show it.
bool open_browser(const std::string& url) {
    const auto is_set = [](const char* name) { return std::getenv(name) != nullptr && *std::getenv(name) != '\0'; };
    if (!is_set("DISPLAY") && !is_set("WAYLAND_DISPLAY")) return true;
    posix_spawn_file_actions_t files;
    posix_spawn_file_actions_init(&files);
    for (const int fd : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO})
        posix_spawn_file_actions_addopen(&files, fd, "/dev/null", O_RDWR, 0);
    posix_spawnattr_t attributes;
    posix_spawnattr_init(&attributes);
    posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETSID);  // Ctrl-C must not end the browser
    std::string program = "xdg-open", address = url;
    char* const arguments[] = {program.data(), address.data(), nullptr};
    pid_t child = 0;
    const int error = posix_spawnp(&child, program.c_str(), &files, &attributes, arguments, environ);
    posix_spawnattr_destroy(&attributes);
    posix_spawn_file_actions_destroy(&files);
    return error == 0;
}

}  // namespace

void run_view(const Arguments& a) {
    keep_freed_memory(a.threads);  // the next frame needs as much
    ViewedScene scene({a.input, a.style, a.overrides}, {a.threads, a.model_budget});
    ViewServer server(scene, a.port);
    if (!a.quiet) {
        for (const std::string& note : scene.notes())
            std::fprintf(stderr, "burin: note: %s\n", printable(note, 4000).c_str());
        std::fprintf(stderr, "burin: showing %s; Ctrl-C ends it\n", printable(a.input, 400).c_str());
    }
    std::printf("%s\n", server.url().c_str());
    if (std::fflush(stdout) != 0)
        throw InputError("standard output: cannot write the page's address; is the reader gone?");
    if (a.opens_browser && !open_browser(server.url()) && !a.quiet)
        std::fputs(
            "burin: note: xdg-open (package xdg-utils) is not there to open a browser; open the address in one\n",
            stderr);
    server.run();
}

}  // namespace burin
