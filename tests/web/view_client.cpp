#include "tests/web/view_client.h"

#include <arpa/inet.h>
#include <gtest/gtest.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <sys/time.h>
#include <unistd.h>

#include <chrono>
#include <fstream>
#include <nlohmann/json.hpp>
#include <thread>

namespace burin::test {

RunningView::RunningView(const std::string& folder, std::vector<std::string> arguments) {
    const std::string out_file = folder + "/address.txt";
    std::ofstream(out_file).flush();
    ProgramOptions options;
    options.stdout_file = out_file;
    arguments.insert(arguments.begin(), "view");
    arguments.emplace_back("--no-browser");
    program_ = std::make_unique<Program>(folder, arguments, options);
    for (int i = 0; i < 2000 && out_.find('\n') == std::string::npos; ++i) {
        std::this_thread::sleep_for(std::chrono::milliseconds(10));
        if (::access(out_file.c_str(), R_OK) == 0) out_ = read_file(out_file);
    }
    const std::size_t colon = out_.rfind(':'), slash = out_.find('/', colon == std::string::npos ? 0 : colon);
    if (slash == std::string::npos) throw std::runtime_error("burin view printed '" + out_ + "'");
    port_ = static_cast<std::uint16_t>(std::stoi(out_.substr(colon + 1)));
    path_ = out_.substr(slash, out_.find('\n') - slash);
}

ProgramResult RunningView::end(int signal_number) {
    program_->send(signal_number);
    return program_->wait();
}

Connection::Connection(std::uint16_t port) : socket_(::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0)) {
    sockaddr_in place{};
    place.sin_family = AF_INET;
    place.sin_port = htons(port);
    place.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    const timeval limit{20, 0};
    ::setsockopt(socket_, SOL_SOCKET, SO_RCVTIMEO, &limit, sizeof limit);
    if (::connect(socket_, reinterpret_cast<const sockaddr*>(&place), sizeof place) != 0)
        throw std::runtime_error("nobody listens");
}

Connection::~Connection() { ::close(socket_); }

void Connection::send(std::string_view bytes) const {
    while (!bytes.empty()) {
        const ssize_t sent = ::send(socket_, bytes.data(), bytes.size(), MSG_NOSIGNAL);
        if (sent <= 0) return;  // the other side has ended
        bytes.remove_prefix(static_cast<std::size_t>(sent));
    }
}

bool Connection::receive() {
    char buffer[65536];
    const ssize_t count = ::recv(socket_, buffer, sizeof buffer, 0);
    if (count <= 0) return false;
    waiting_.append(buffer, static_cast<std::size_t>(count));
    return true;
}

std::string Connection::read(std::size_t count) {
    while (waiting_.size() < count && receive()) {
    }
    const std::string bytes = waiting_.substr(0, count);
    waiting_.erase(0, bytes.size());
    return bytes;
}

std::string Connection::read_all() {
    while (receive()) {
    }
    return std::exchange(waiting_, {});
}

std::string Connection::read_until(std::string_view end) {
    std::size_t at = 0;
    while ((at = waiting_.find(end)) == std::string::npos) {
        if (!receive()) return std::exchange(waiting_, {});
    }
    return read(at + end.size());
}

std::string get_request(const RunningView& view, const std::string& target, const std::string& fields) {
    const bool has_host = fields.find("Host:") != std::string::npos;
    return "GET " + target + " HTTP/1.1\r\n" + (has_host ? "" : "Host: " + view.host() + "\r\n") + fields + "\r\n";
}

HttpAnswer ask(const RunningView& view, const std::string& request) {
    Connection connection(view.port());
    connection.send(request);
    HttpAnswer answer;
    answer.head = connection.read_until("\r\n\r\n");
    if (answer.head.size() > 12) answer.status = std::stoi(answer.head.substr(9, 3));
    const std::size_t length = answer.head.find("Content-Length: ");
    if (length != std::string::npos) answer.body = connection.read(std::stoul(answer.head.substr(length + 16)));
    return answer;
}

PageSocket::PageSocket(const RunningView& view) : connection_(view.port()) {
    connection_.send(get_request(view, view.path() + "socket",
                                 "Origin: http://" + view.host() +
                                     "\r\nUpgrade: websocket\r\nConnection: Upgrade\r\nSec-WebSocket-Version: 13\r\n"
                                     "Sec-WebSocket-Key: dGhlIHNhbXBsZSBub25jZQ==\r\n"));
    const std::string head = connection_.read_until("\r\n\r\n");
    EXPECT_TRUE(head.starts_with("HTTP/1.1 101")) << head;
}

void PageSocket::send_text(const std::string& text) const { send_frame(0x81, text); }

void PageSocket::send_frame(unsigned first_byte, const std::string& payload, bool is_masked) const {
    const unsigned mask_bit = is_masked ? 0x80 : 0;
    std::string frame(1, static_cast<char>(first_byte));
    const std::size_t length_bytes = payload.size() < 126 ? 0 : payload.size() < 65536 ? 2 : 8;
    const std::size_t marked = length_bytes == 0 ? payload.size() : length_bytes == 2 ? 126 : 127;
    frame += static_cast<char>(mask_bit | marked);
    for (std::size_t i = length_bytes; i-- > 0;) frame += static_cast<char>(payload.size() >> 8 * i & 0xFF);
    const std::string mask = is_masked ? "\x12\x34\x56\x78" : "";
    frame += mask;
    for (std::size_t i = 0; i < payload.size(); ++i)
        frame += is_masked ? static_cast<char>(payload[i] ^ mask[i % 4]) : payload[i];
    connection_.send(frame);
}

std::optional<SocketAnswer> PageSocket::receive() {
    const auto byte = [](char c) { return static_cast<std::size_t>(static_cast<unsigned char>(c)); };
    for (;;) {
        const std::string head = connection_.read(2);
        if (head.size() < 2) return std::nullopt;
        std::size_t length = byte(head[1]) & 0x7F;
        if (length >= 126) {
            const std::string text = connection_.read(length == 126 ? 2 : 8);
            length = 0;
            for (const char c : text) length = length << 8 | byte(c);
        }
        const std::string payload = connection_.read(length);
        const std::size_t kind = byte(head[0]) & 0x0F;
        if (payload.size() < length || kind == 8) return std::nullopt;
        if (kind == 1) return SocketAnswer{payload, {}};
        if (kind != 2 || payload.size() < 4) continue;
        std::size_t text_size = 0;
        for (std::size_t i = 4; i-- > 0;) text_size = text_size << 8 | byte(payload[i]);
        return SocketAnswer{payload.substr(4, text_size), payload.substr(4 + text_size)};
    }
}

std::optional<SocketAnswer> PageSocket::receive(const std::string& kind, int number) {
    while (auto answer = receive()) {
        const auto json = nlohmann::json::parse(answer->text);
        if (json["kind"] == kind && (number < 0 || json["number"] == number)) return answer;
    }
    return std::nullopt;
}

std::string view_message(const std::string& kind, int number, int width, int height, const std::string& more) {
    return "kind = \"" + kind + "\"\nnumber = " + std::to_string(number) + "\nsize = [" + std::to_string(width) + ", " +
           std::to_string(height) + "]\n" + more +
           "\n[camera]\neye = [2.5, 1.5, 3]\ntarget = [0, 0, 0]\nup = [0, 1, 0]\nfov = 35\n";
}

}  // namespace burin::test
