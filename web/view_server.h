#pragma once

#include <cstdint>
#include <memory>
#include <string>

#include "web/viewed_scene.h"

namespace burin {

/// ViewServer shows a scene to browsers on this machine: a page and a WebSocket per page, on one port of 127.0.0.1.
/// It writes no file, and no request names one.
class ViewServer {
  public:
    /// Listens from now on. `port`: 0 = a free one. Throws InputError, when the port is taken.
    ViewServer(ViewedScene& scene, std::uint16_t port);
    ~ViewServer();
    ViewServer(const ViewServer&) = delete;
    ViewServer& operator=(const ViewServer&) = delete;

    /// Where the page is. Who knows it can look.
    std::string url() const;
    /// Answers until a signal asks the program to end, as install_interrupt_handlers() has them, or stop().
    void run();
    /// Any thread may call it.
    void stop();

    struct Inner;

  private:
    std::unique_ptr<Inner> inner_;
};

}  // namespace burin
