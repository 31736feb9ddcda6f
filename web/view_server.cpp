#include "web/view_server.h"

#include <utility>  // before Boost's Asio 1.74, which lacks it in C++20

#include <boost/asio/io_context.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/post.hpp>
#include <boost/asio/signal_set.hpp>
#include <boost/asio/steady_timer.hpp>
#include <boost/beast/core/flat_buffer.hpp>
#include <boost/beast/core/tcp_stream.hpp>
#include <boost/beast/http/empty_body.hpp>
#include <boost/beast/http/parser.hpp>
#include <boost/beast/http/read.hpp>
#include <boost/beast/http/span_body.hpp>
#include <boost/beast/http/string_body.hpp>
#include <boost/beast/http/write.hpp>
#include <boost/beast/websocket/rfc6455.hpp>
#include <boost/beast/websocket/stream.hpp>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <deque>
#include <optional>
#include <set>
#include <vector>

#include "base/error.h"
#include "base/interrupt.h"
#include "web/gatekeeper.h"
#include "web/view_session.h"

namespace burin {
namespace {

namespace asio = boost::asio;
namespace beast = boost::beast;
namespace http = beast::http;
namespace websocket = beast::websocket;
using tcp = asio::ip::tcp;
using boost::system::error_code;

constexpr std::chrono::seconds kHeadTime{5}, kAnswerTime{30};
constexpr std::uint32_t kMostHeadBytes = 16 * 1024;
constexpr std::size_t kMostConnections = 64, kMostSockets = 16;
/// A connection that cannot be accepted, for want of file descriptors above all, stays in the queue: asking again at
/// once would find it there at once.
constexpr std::chrono::milliseconds kAcceptPause{100};
/// A page that does not take its answers is asked for nothing more until it does.
constexpr std::size_t kMostWaitingAnswers = 8;

std::string_view std_view(boost::string_view text) { return {text.data(), text.size()}; }

class Connection;

/// Sessions whose pages are gone, until their threads have ended.
class EndedSessions {
  public:
    void add(std::unique_ptr<ViewSession> session) {
        session->stop();
        sessions_.push_back(std::move(session));
        std::erase_if(sessions_, [](const auto& s) { return s->is_done(); });
    }

  private:
    std::vector<std::unique_ptr<ViewSession>> sessions_;
};

}  // namespace

struct ViewServer::Inner {
    ViewedScene& scene;
    asio::io_context io{1};
    tcp::acceptor acceptor{io};
    asio::signal_set signals{io};
    asio::steady_timer accept_pause{io};
    std::optional<Gatekeeper> gate;
    std::set<std::shared_ptr<Connection>> connections;
    std::size_t sockets = 0;
    EndedSessions ended;

    explicit Inner(ViewedScene& s) : scene(s) {}
    void accept();
    void close_all();
};

namespace {

/// A connection of a browser: requests one after the other, until one makes it a WebSocket. All of it runs on the
/// server's thread but for what it is given to send.
class Connection : public std::enable_shared_from_this<Connection> {
  public:
    Connection(ViewServer::Inner& server, tcp::socket&& socket) : server_(server), stream_(std::move(socket)) {}

    void read_request() {
        parser_.emplace();
        parser_->header_limit(kMostHeadBytes);
        parser_->body_limit(0);
        stream_.expires_after(kHeadTime);
        http::async_read_header(stream_, buffer_, *parser_, [self = shared_from_this()](error_code error, std::size_t) {
            self->on_request(error);
        });
    }

    void close() {
        if (session_) {
            --server_.sockets;
            server_.ended.add(std::move(session_));
        }
        error_code ignored;
        if (socket_) {
            beast::get_lowest_layer(*socket_).socket().close(ignored);
        } else {
            stream_.socket().close(ignored);
        }
        server_.connections.erase(shared_from_this());
    }

  private:
    using Response = http::response<http::span_body<const char>>;

    static std::vector<std::string_view> all_of(const http::request<http::empty_body>& request, http::field name) {
        std::vector<std::string_view> values;
        const auto [first, last] = request.equal_range(name);
        for (auto at = first; at != last; ++at) values.push_back(std_view(at->value()));
        return values;
    }
    static std::vector<std::string_view> all_of(const http::request<http::empty_body>& request, const char* name) {
        std::vector<std::string_view> values;
        const auto [first, last] = request.equal_range(name);
        for (auto at = first; at != last; ++at) values.push_back(std_view(at->value()));
        return values;
    }

    void on_request(error_code error) {
        if (error == http::error::header_limit) return send({Verdict::Kind::refusal, 431, {}, {}}, false);
        if (error == http::error::body_limit) return send({Verdict::Kind::refusal, 413, {}, {}}, false);
        const bool is_gone = error == http::error::end_of_stream || error == http::error::partial_message;
        if (error && (is_gone || error.category() != make_error_code(http::error::bad_method).category()))
            return close();
        if (error) return send({Verdict::Kind::refusal, 400, {}, {}}, false);
        const http::request<http::empty_body>& request = parser_->get();
        RequestHead head;
        head.method = std_view(request.method_string());
        head.target = std_view(request.target());
        head.hosts = all_of(request, http::field::host);
        head.origins = all_of(request, http::field::origin);
        head.fetch_sites = all_of(request, "Sec-Fetch-Site");
        head.has_body = request.has_content_length() ? std_view(request[http::field::content_length]) != "0"
                                                     : request.count(http::field::transfer_encoding) > 0;
        head.is_upgrade = websocket::is_upgrade(request);
        const Verdict verdict = server_.gate->judge(head);
        if (verdict.kind != Verdict::Kind::socket) return send(verdict, request.keep_alive() && !head.has_body);
        if (server_.sockets >= kMostSockets) return send({Verdict::Kind::refusal, 503, {}, {}}, false);
        become_socket();
    }

    void send(const Verdict& verdict, bool keeps_alive) {
        response_.emplace();
        response_->result(static_cast<unsigned>(verdict.status));
        response_->version(11);
        const bool is_file = verdict.kind == Verdict::Kind::file;
        if (!is_file)
            refusal_ = std::to_string(verdict.status) + " " + std::string(std_view(response_->reason())) + "\n";
        const std::string_view text = is_file ? verdict.text : std::string_view(refusal_);
        response_->set(http::field::content_type,
                       beast::string_view(is_file ? verdict.type.data() : "text/plain; charset=utf-8",
                                          is_file ? verdict.type.size() : 25));
        for (const AnswerField& field : answer_fields()) {
            response_->set(beast::string_view(field.name.data(), field.name.size()),
                           beast::string_view(field.value.data(), field.value.size()));
        }
        response_->keep_alive(keeps_alive);
        response_->body() = {text.data(), text.size()};
        response_->prepare_payload();
        stream_.expires_after(kAnswerTime);
        http::async_write(stream_, *response_, [self = shared_from_this(), keeps_alive](error_code error, std::size_t) {
            if (error || !keeps_alive) return self->close();
            self->read_request();
        });
    }

    void become_socket() {
        stream_.expires_never();
        stream_.socket().set_option(tcp::no_delay(true));
        socket_.emplace(std::move(stream_));
        ++server_.sockets;
        auto timeout = websocket::stream_base::timeout::suggested(beast::role_type::server);
        timeout.handshake_timeout = kHeadTime;
        socket_->set_option(timeout);
        socket_->read_message_max(kMostMessageBytes);
        socket_->auto_fragment(false);
        socket_->write_buffer_bytes(1 << 16);
        // The session's thread sends by way of the server's.
        session_ = std::make_unique<ViewSession>(server_.scene,
                                                 [weak = weak_from_this(), &io = server_.io](ViewAnswer answer) {
                                                     auto shared = std::make_shared<ViewAnswer>(std::move(answer));
                                                     asio::post(io, [weak, shared] {
                                                         if (const auto self = weak.lock())
                                                             self->queue(std::move(*shared));
                                                     });
                                                 });
        socket_->async_accept(parser_->get(), [self = shared_from_this()](error_code error) {
            if (error) return self->close();
            self->is_open_ = true;
            self->read_message();
            self->write_next();
        });
    }

    void read_message() {
        is_reading_ = true;
        socket_->async_read(message_, [self = shared_from_this()](error_code error, std::size_t) {
            self->is_reading_ = false;
            if (error || !self->session_) return self->close();
            const auto bytes = self->message_.cdata();
            self->session_->receive({static_cast<const char*>(bytes.data()), bytes.size()});
            self->message_.consume(self->message_.size());
            if (self->answers_.size() < kMostWaitingAnswers) self->read_message();
        });
    }

    void queue(ViewAnswer&& answer) {
        if (!session_) return;
        answers_.push_back(std::move(answer));
        if (is_open_ && answers_.size() == 1) write_next();
    }

    void write_next() {
        if (answers_.empty()) return;
        const ViewAnswer& answer = answers_.front();
        socket_->text(answer.is_text);
        socket_->async_write(asio::buffer(answer.bytes), [self = shared_from_this()](error_code error, std::size_t) {
            if (error || !self->session_) return self->close();
            self->answers_.pop_front();
            self->write_next();
            if (!self->is_reading_ && self->answers_.size() < kMostWaitingAnswers) self->read_message();
        });
    }

    ViewServer::Inner& server_;
    beast::tcp_stream stream_;
    beast::flat_buffer buffer_;
    std::optional<http::request_parser<http::empty_body>> parser_;
    std::optional<Response> response_;
    std::string refusal_;
    // Of a WebSocket:
    std::optional<websocket::stream<beast::tcp_stream>> socket_;
    beast::flat_buffer message_;
    std::unique_ptr<ViewSession> session_;
    std::deque<ViewAnswer> answers_;  // the first one is being sent, once it is open
    bool is_open_ = false, is_reading_ = false;
};

}  // namespace

void ViewServer::Inner::accept() {
    acceptor.async_accept([this](error_code error, tcp::socket socket) {
        if (!acceptor.is_open()) return;
        if (!error && connections.size() < kMostConnections) {
            const auto connection = std::make_shared<Connection>(*this, std::move(socket));
            connections.insert(connection);
            connection->read_request();
        }
        if (!error) return accept();
        accept_pause.expires_after(kAcceptPause);
        accept_pause.async_wait([this](error_code is_cancelled) {
            if (!is_cancelled && acceptor.is_open()) accept();
        });
    });
}

void ViewServer::Inner::close_all() {
    error_code ignored;
    acceptor.close(ignored);
    signals.cancel(ignored);
    accept_pause.cancel();
    while (!connections.empty()) std::shared_ptr<Connection>(*connections.begin())->close();
    io.stop();
}

ViewServer::ViewServer(ViewedScene& scene, std::uint16_t port) : inner_(std::make_unique<Inner>(scene)) {
    const tcp::endpoint place(asio::ip::address_v4::loopback(), port);
    error_code error;
    inner_->acceptor.open(place.protocol(), error);
    if (!error) inner_->acceptor.set_option(tcp::acceptor::reuse_address(true), error);
    if (!error) inner_->acceptor.bind(place, error);
    if (!error) inner_->acceptor.listen(asio::socket_base::max_listen_connections, error);
    if (error) {
        const std::string where = "127.0.0.1:" + std::to_string(port) + ": ";
        if (error == asio::error::address_in_use)
            throw InputError(where + "the port is in use; give another --port, or none for a free one");
        throw InputError(where + "cannot listen: " + error.message() + "; give another --port, or none for a free one");
    }
    inner_->gate.emplace(inner_->acceptor.local_endpoint().port(), random_token());
}

ViewServer::~ViewServer() = default;

std::string ViewServer::url() const { return inner_->gate->url(); }

void ViewServer::run() {
    for (const int number : {SIGINT, SIGTERM, SIGHUP, SIGQUIT, SIGXCPU}) {
        struct sigaction action {};
        const bool is_ignored =
            number == SIGHUP && sigaction(number, nullptr, &action) == 0 && action.sa_handler == SIG_IGN;
        if (!is_ignored) inner_->signals.add(number);
    }
    inner_->signals.async_wait([this](error_code error, int) {
        if (!error) inner_->close_all();
    });
    if (interrupt_requested()) return;  // a signal that came before this one listened
    inner_->accept();
    inner_->io.run();
}

void ViewServer::stop() {
    asio::post(inner_->io, [this] { inner_->close_all(); });
}

}  // namespace burin
