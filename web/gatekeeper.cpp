#include "web/gatekeeper.h"

#include <sys/random.h>

#include <algorithm>
#include <array>
#include <utility>

#include "base/error.h"
#include "web/page_files.h"

namespace burin {
namespace {

/// Takes as long whichever character differs.
bool is_same(std::string_view a, std::string_view b) {
    if (a.size() != b.size()) return false;
    unsigned differing = 0;
    for (std::size_t i = 0; i < a.size(); ++i) differing |= static_cast<unsigned char>(a[i] ^ b[i]);
    return differing == 0;
}

Verdict refusal(int status) { return {Verdict::Kind::refusal, status, {}, {}}; }

}  // namespace

Gatekeeper::Gatekeeper(std::uint16_t port, std::string token) : path_("/" + std::move(token) + "/") {
    for (const char* const name : {"127.0.0.1", "localhost"}) hosts_.push_back(name + (":" + std::to_string(port)));
}

std::string Gatekeeper::url() const { return "http://" + hosts_.front() + path_; }

bool Gatekeeper::is_ours(const RequestHead& head) const {
    if (head.hosts.size() != 1 || head.origins.size() > 1 || head.fetch_sites.size() > 1) return false;
    const auto host = std::find(hosts_.begin(), hosts_.end(), head.hosts.front());
    if (host == hosts_.end()) return false;
    // A page under the one name must not be asked from under the other.
    if (!head.origins.empty() && head.origins.front() != "http://" + *host) return false;
    if (!head.fetch_sites.empty() && head.fetch_sites.front() != "same-origin" && head.fetch_sites.front() != "none")
        return false;
    return is_same(head.target.substr(0, path_.size()), path_);
}

Verdict Gatekeeper::judge(const RequestHead& head) const {
    if (!is_ours(head)) return refusal(403);
    if (head.method != "GET") return refusal(405);
    if (head.has_body) return refusal(413);
    const std::string_view name = head.target.substr(path_.size());
    if (name == "socket") {
        // Only a browser's page is let in, which says where it comes from.
        if (head.origins.empty()) return refusal(403);
        return head.is_upgrade ? Verdict{Verdict::Kind::socket, 101, {}, {}} : refusal(400);
    }
    for (const PageFile& file : page_files()) {
        if (file.name == name) return {Verdict::Kind::file, 200, file.type, file.text};
    }
    return refusal(404);
}

std::string random_token() {
    std::array<unsigned char, 16> bytes;
    if (::getrandom(bytes.data(), bytes.size(), 0) != static_cast<ssize_t>(bytes.size()))
        throw InputError("the system gives no random numbers, which the address of the page needs");
    std::string token;
    for (const unsigned char byte : bytes) {
        token += "0123456789abcdef"[byte >> 4];
        token += "0123456789abcdef"[byte & 15];
    }
    return token;
}

const std::vector<AnswerField>& answer_fields() {
    static const std::vector<AnswerField> fields = {
        {"Cache-Control", "no-store"},
        {"Content-Security-Policy",
         "default-src 'none'; script-src 'self'; style-src 'self'; img-src 'self' blob: data:; connect-src 'self'; "
         "base-uri 'none'; form-action 'none'; frame-ancestors 'none'"},
        {"Cross-Origin-Opener-Policy", "same-origin"},
        {"Cross-Origin-Resource-Policy", "same-origin"},
        {"Referrer-Policy", "no-referrer"},
        {"X-Content-Type-Options", "nosniff"},
        {"X-Frame-Options", "DENY"},
    };
    return fields;
}

}  // namespace burin
