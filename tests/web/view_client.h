#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "tests/cli/program.h"
#include "tests/support/temporary_folder.h"

// What speaks to `burin view` over raw sockets, so that it can also say what no browser says.

namespace burin::test {

/// A program `burin view` that runs until this is gone.
class RunningView {
  public:
    /// `arguments`: behind `view`. Waits for the address.
    RunningView(const std::string& folder, std::vector<std::string> arguments);

    /// What stands on standard output, one line.
    const std::string& out() const { return out_; }
    std::uint16_t port() const { return port_; }
    const std::string& path() const { return path_; }  ///< "/TOKEN/"
    std::string host() const { return "127.0.0.1:" + std::to_string(port_); }
    /// Sends a signal and waits until it ends.
    ProgramResult end(int signal_number);

  private:
    std::string out_, path_;
    std::uint16_t port_ = 0;
    std::unique_ptr<Program> program_;
};

/// A TCP connection to a port of 127.0.0.1.
class Connection {
  public:
    explicit Connection(std::uint16_t port);
    ~Connection();
    Connection(const Connection&) = delete;
    Connection& operator=(const Connection&) = delete;

    void send(std::string_view bytes) const;
    /// `count` bytes; fewer where the other side ends, or says nothing for 20 s.
    std::string read(std::size_t count);
    /// All until the other side ends.
    std::string read_all();
    /// A text up to and with an end.
    std::string read_until(std::string_view end);

  private:
    bool receive();

    int socket_ = -1;
    std::string waiting_;
};

struct HttpAnswer {
    int status = 0;
    std::string head, body;
};

/// Sends a request and reads its answer; the connection is closed then.
HttpAnswer ask(const RunningView& view, const std::string& request);
/// A GET as a browser sends it. `fields`: instead of that of Host, if it has one, and beside it.
std::string get_request(const RunningView& view, const std::string& target, const std::string& fields = {});

/// An answer on a WebSocket: a text alone, or in front of bytes.
struct SocketAnswer {
    std::string text, bytes;
};

/// A page's WebSocket.
class PageSocket {
  public:
    explicit PageSocket(const RunningView& view);

    void send_text(const std::string& text) const;
    /// A frame as it is, whose bytes are masked where `is_masked`.
    void send_frame(unsigned first_byte, const std::string& payload, bool is_masked = true) const;
    /// The next answer; nothing if the server has closed the connection.
    std::optional<SocketAnswer> receive();
    /// The next answer with this kind, and this number unless it is negative; others are skipped.
    std::optional<SocketAnswer> receive(const std::string& kind, int number = -1);

  private:
    Connection connection_;
};

/// A message with a view of things around 0. `more`: its other keys.
std::string view_message(const std::string& kind, int number, int width, int height, const std::string& more = {});

}  // namespace burin::test
