#include "scene/parse_toml.h"

#include <algorithm>
#include <cstddef>
#include <istream>
#include <streambuf>

#include "base/interrupt.h"
#include "scene/toml_depth.h"

namespace burin {
namespace {

/// A text as a stream that ends where the user asks the program to stop.
class StoppableText : public std::streambuf {
  public:
    explicit StoppableText(std::string_view text) : text_(text) { go_to(0); }

  protected:
    int_type underflow() override {
        if (interrupt_requested()) return traits_type::eof();
        go_to(static_cast<std::size_t>(egptr() - text_.data()));
        return gptr() == egptr() ? traits_type::eof() : traits_type::to_int_type(*gptr());
    }
    // toml++ goes back to the beginning if there is no byte order mark.
    pos_type seekoff(off_type offset, std::ios_base::seekdir from, std::ios_base::openmode) override {
        const off_type start = from == std::ios_base::beg   ? 0
                               : from == std::ios_base::cur ? static_cast<off_type>(gptr() - text_.data())
                                                            : static_cast<off_type>(text_.size());
        return seekpos(start + offset, std::ios_base::in);
    }
    pos_type seekpos(pos_type position, std::ios_base::openmode) override {
        const off_type place = position;
        if (place < 0 || place > static_cast<off_type>(text_.size())) return pos_type(off_type(-1));
        go_to(static_cast<std::size_t>(place));
        return position;
    }

  private:
    void go_to(std::size_t place) {
        constexpr std::size_t kPiece = 1 << 16;
        char* const begin = const_cast<char*>(text_.data()) + place;  // nothing is put back into it
        setg(begin, begin, begin + std::min(kPiece, text_.size() - place));
    }

    std::string_view text_;
};

}  // namespace

toml::table parse_toml(std::string_view text, const std::string& path) {
    try {
        StoppableText buffer(text);
        std::istream stream(&buffer);
        toml::table tables = toml::parse(stream, path);
        throw_if_interrupted();
        return tables;
    } catch (const toml::parse_error&) {
        throw_if_interrupted();  // it ended too early
        throw;
    }
}

toml::table parse_checked_toml(std::string_view text, const std::string& path, const std::string& what,
                               std::size_t most_bytes, std::size_t most_values) {
    if (text.size() > most_bytes) {
        const std::string most =
            most_bytes >= 1 << 20 ? std::to_string(most_bytes >> 20) + " MB" : std::to_string(most_bytes >> 10) + " kB";
        throw InputError(path + ": " + what + " of more than " + most + "; is it a model?");
    }
    if (const auto line = line_nested_too_deep(text)) throw InputError({path, *line}, kTomlTooDeep);
    if (const auto line = most_values == 0 ? std::nullopt : line_with_too_many_values(text, most_values)) {
        throw InputError({path, *line}, what + " of more than " + std::to_string(most_values / kValuesPerTable) +
                                            " keys, tables and lists, or " + std::to_string(most_values) + " values");
    }
    try {
        return parse_toml(text, path);
    } catch (const toml::parse_error& error) {
        const toml::source_position at = error.source().begin;
        std::string message(error.description());
        std::replace(message.begin(), message.end(), '\n', ' ');
        throw InputError({path, at.line, at.column}, message);
    }
}

}  // namespace burin
