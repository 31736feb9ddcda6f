#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace burin {

/// The head of a request, as far as it decides what is answered. Texts of fields that it has not are empty.
struct RequestHead {
    std::string_view method, target;
    std::vector<std::string_view> hosts, origins, fetch_sites;  ///< all fields of that name
    bool has_body = false;
    bool is_upgrade = false;  ///< asks for a WebSocket
};

/// What is answered.
struct Verdict {
    enum class Kind : std::uint8_t {
        file,     ///< a part of the page
        socket,   ///< the connection becomes a WebSocket
        refusal,  ///< with `status`
    };
    Kind kind = Kind::refusal;
    int status = 403;
    std::string_view type, text;
};

/// Gatekeeper decides which requests a page of this server may have sent. Any page of any site that the user looks at
/// can send requests to his machine, and may even have a name that leads there, so that a request must know the random
/// path, which is told to the user alone, must name this server as its host, and must not come from another page.
class Gatekeeper {
  public:
    /// `token`: of the path, random.
    Gatekeeper(std::uint16_t port, std::string token);

    Verdict judge(const RequestHead& head) const;
    /// Where the page is.
    std::string url() const;

  private:
    bool is_ours(const RequestHead& head) const;

    std::vector<std::string> hosts_;
    std::string path_;  ///< "/TOKEN/"
};

/// 128 random bits in hexadecimal digits. Throws InputError if the system has none.
std::string random_token();

/// Fields that each answer has, but for its type and length.
struct AnswerField {
    std::string_view name, value;
};
const std::vector<AnswerField>& answer_fields();

}  // namespace burin
