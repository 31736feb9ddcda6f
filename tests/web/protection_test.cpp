// Who may look: what other pages, other programs and broken clients send is refused, and harms nobody else.

#include <gtest/gtest.h>

#include <functional>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "tests/web/view_client.h"
#include "web/gatekeeper.h"

namespace burin::test::protection_test {
namespace {

constexpr const char* kBox = "[[object]]\nshape = \"box\"\n";

struct Viewed {
    TemporaryFolder folder;
    std::unique_ptr<RunningView> view;

    Viewed() {
        folder.write("box.toml", kBox);
        view = std::make_unique<RunningView>(folder.path(), std::vector<std::string>{"box.toml", "-q", "-j", "1"});
    }
};

TEST(Protection, ThePageHasAllItsFields) {
    const Viewed viewed;
    const HttpAnswer page = ask(*viewed.view, get_request(*viewed.view, viewed.view->path()));
    EXPECT_EQ(page.status, 200);
    EXPECT_TRUE(page.body.starts_with("<!doctype html>"));
    for (const char* const field :
         {"Content-Type: text/html; charset=utf-8", "Content-Security-Policy: default-src 'none'; script-src 'self';",
          "frame-ancestors 'none'", "X-Content-Type-Options: nosniff", "Referrer-Policy: no-referrer",
          "Cross-Origin-Resource-Policy: same-origin", "Cache-Control: no-store"}) {
        EXPECT_NE(page.head.find(field), std::string::npos) << field;
    }
    // No script and no style stands in the page, so that none that somebody brings into it would run.
    EXPECT_EQ(page.body.find("<script>"), std::string::npos);
    EXPECT_EQ(page.body.find("<style"), std::string::npos);
    EXPECT_EQ(page.body.find(" style="), std::string::npos);
    for (const char* const name : {"view.js", "view.css", "icon.svg"})
        EXPECT_EQ(ask(*viewed.view, get_request(*viewed.view, viewed.view->path() + name)).status, 200) << name;
}

TEST(Protection, ForgedRequestsAreRefused) {
    const Viewed viewed;
    const RunningView& view = *viewed.view;
    const std::string port = ":" + std::to_string(view.port()), path = view.path();
    const std::string other_token = "/" + std::string(32, '0') + "/";
    const std::pair<std::string, std::string> forged[] = {
        {path, "Host: evil.example" + port + "\r\n"},
        {path, "Host: 127.0.0.1\r\n"},
        {path, "Host: 127.0.0.1:1\r\n"},
        {path, "Host: 127.0.0.1" + port + "\r\nHost: 127.0.0.1" + port + "\r\n"},
        {path, "Origin: http://evil.example\r\n"},
        {path, "Origin: https://127.0.0.1" + port + "\r\n"},
        {path, "Origin: http://localhost" + port + "\r\n"},
        {path, "Origin: null\r\n"},
        {path, "Sec-Fetch-Site: cross-site\r\n"},
        {path, "Sec-Fetch-Site: same-site\r\n"},
        {path, "Sec-Fetch-Site: none\r\nSec-Fetch-Site: cross-site\r\n"},
        {"/", ""},
        {"/view.js", ""},
        {other_token, ""},
        {other_token + "socket", "Origin: http://127.0.0.1" + port + "\r\n"},
        {path.substr(0, path.size() - 2) + "/", ""},
        {path + "socket", ""},
        {path + "socket", "Origin: http://evil.example\r\n"},
    };
    for (const auto& [target, fields] : forged)
        EXPECT_EQ(ask(view, get_request(view, target, fields)).status, 403) << target << "\n" << fields;
    EXPECT_EQ(ask(view, "GET " + path + " HTTP/1.0\r\n\r\n").status, 403);  // no host at all
    const std::string own = "Host: localhost" + port + "\r\nOrigin: http://localhost" + port + "\r\n";
    EXPECT_EQ(ask(view, get_request(view, path, own + "Sec-Fetch-Site: same-origin\r\n")).status, 200);
}

TEST(Protection, NothingButThePageIsServed) {
    const Viewed viewed;
    const RunningView& view = *viewed.view;
    for (const char* const name : {"../../etc/passwd", "%2e%2e/etc/passwd", "/etc/passwd", "box.toml", "view.js/", "?",
                                   "view.js?file=/etc/passwd", "VIEW.JS"}) {
        EXPECT_EQ(ask(view, get_request(view, view.path() + name)).status, 404) << name;
    }
    for (const char* const method : {"POST", "PUT", "DELETE", "OPTIONS", "HEAD", "TRACE"}) {
        const std::string request = std::string(method) + " " + view.path() + " HTTP/1.1\r\nHost: " + view.host();
        EXPECT_EQ(ask(view, request + "\r\nContent-Length: 0\r\n\r\n").status, 405) << method;
    }
    EXPECT_EQ(ask(view, get_request(view, view.path(), "Content-Length: 3\r\n") + "abc").status, 413);
    EXPECT_EQ(ask(view, get_request(view, view.path(), "Transfer-Encoding: chunked\r\n")).status, 413);
    EXPECT_EQ(ask(view, get_request(view, view.path() + "socket", "Origin: http://" + view.host() + "\r\n")).status,
              400);
}

TEST(Protection, BrokenRequestsEndTheirConnection) {
    const Viewed viewed;
    const RunningView& view = *viewed.view;
    EXPECT_EQ(ask(view, get_request(view, view.path(), "X: " + std::string(20000, 'x') + "\r\n")).status, 431);
    EXPECT_EQ(ask(view, get_request(view, "/" + std::string(100000, 'x'))).status, 431);
    for (const char* const garbage : {"\x16\x03\x01\x02garbage\r\n\r\n", "GET\r\n\r\n", "\r\n\r\n\r\n\r\nX\r\n\r\n"}) {
        const int status = ask(view, garbage).status;
        EXPECT_TRUE(status == 0 || status == 400) << status;
    }
    EXPECT_EQ(ask(view, get_request(view, view.path())).status, 200);
}

TEST(Protection, SlowClientsBlockNobody) {
    const Viewed viewed;
    const RunningView& view = *viewed.view;
    std::vector<std::unique_ptr<Connection>> slow;
    for (int i = 0; i < 30; ++i) {
        slow.push_back(std::make_unique<Connection>(view.port()));
        slow.back()->send("GET / HT");
    }
    PageSocket never_reads(view);
    for (int i = 0; i < 40; ++i) never_reads.send_text(view_message("save", i, 800, 600, "format = \"svg\""));
    EXPECT_EQ(ask(view, get_request(view, view.path())).status, 200);
    PageSocket page(view);
    page.send_text(view_message("draw", 7, 64, 48));
    EXPECT_TRUE(page.receive("frame", 7));
}

TEST(Protection, TooManyConnectionsAreClosed) {
    const Viewed viewed;
    std::vector<std::unique_ptr<Connection>> many;
    for (int i = 0; i < 70; ++i) many.push_back(std::make_unique<Connection>(viewed.view->port()));
    EXPECT_EQ(many.back()->read_all(), "");  // it was not even read
    many.clear();
    for (int i = 0; i < 100; ++i) {
        if (ask(*viewed.view, get_request(*viewed.view, viewed.view->path())).status == 200) return;
    }
    FAIL() << "it is not served any more";
}

TEST(Protection, BrokenFramesEndTheirSocketAlone) {
    const Viewed viewed;
    PageSocket other(*viewed.view);
    const std::vector<std::function<void(PageSocket&)>> breaks = {
        [](PageSocket& page) { page.send_frame(0x81, "kind = \"draw\"", false); },  // not masked
        [](PageSocket& page) { page.send_frame(0xF1, "reserved bits"); },
        [](PageSocket& page) { page.send_frame(0x83, "no such kind of frame"); },
        [](PageSocket& page) { page.send_frame(0x80, "goes on with nothing"); },
        [](PageSocket& page) { page.send_frame(0x81, "\xFF\xFE no UTF-8"); },
        [](PageSocket& page) { page.send_text(std::string(70000, '#')); },  // too long
    };
    for (std::size_t i = 0; i < breaks.size(); ++i) {
        PageSocket page(*viewed.view);
        ASSERT_TRUE(page.receive("hello"));
        breaks[i](page);
        EXPECT_FALSE(page.receive()) << i;
    }
    other.send_text(view_message("draw", 3, 64, 48));
    EXPECT_TRUE(other.receive("frame", 3));
}

TEST(Protection, TokensAreRandom) {
    const std::string a = random_token(), b = random_token();
    EXPECT_EQ(a.size(), 32u);
    EXPECT_EQ(a.find_first_not_of("0123456789abcdef"), std::string::npos);
    EXPECT_NE(a, b);
}

}  // namespace
}  // namespace burin::test::protection_test
