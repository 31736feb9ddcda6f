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

std::string_view line_of(std::string_view text, std::size_t number) {
    for (std::size_t line = 1; line < number; ++line) {
        const std::size_t end = text.find('\n');
        if (end == std::string_view::npos) return {};
        text.remove_prefix(end + 1);
    }
    return text.substr(0, text.find('\n'));
}

/// A line without its strings and its comment.
std::string bare(std::string_view line) {
    std::string rest;
    char quote = 0;
    for (std::size_t i = 0; i < line.size(); ++i) {
        const char c = line[i];
        if (quote != 0) {
            if (c == '\\' && quote == '"') ++i;
            if (c == quote) quote = 0;
        } else if (c == '#') {
            break;
        } else if (c == '"' || c == '\'') {
            quote = c;
        } else {
            rest += c;
        }
    }
    return rest;
}

/// What to do about common mistakes in TOML itself, whose messages name the consequence: "; ...", or nothing.
std::string hint_for(std::string_view line, std::string_view message) {
    const auto has = [&](std::string_view words) { return message.find(words) != std::string_view::npos; };
    const auto is_control = [](char c) { return static_cast<unsigned char>(c) < 0x20 && c != '\t' && c != '\r'; };
    if (has("string") && (has("control characters") || has("end-of-file")) &&
        std::none_of(line.begin(), line.end(), is_control))
        return "; is the closing quote missing?";
    const std::string code = bare(line);
    for (const std::string_view quote : {"\xE2\x80\x9C", "\xE2\x80\x9D", "\xE2\x80\x9E", "\xE2\x80\x98", "\xE2\x80\x99",
                                         "\xE2\x80\x9A", "\xC2\xAB", "\xC2\xBB"}) {
        if (code.find(quote) != std::string::npos) return "; quotes are written \" here";
    }
    if (!has("redefine")) return {};
    for (const std::string_view list : {"set", "object", "camera", "material", "light"}) {
        const std::string once = "[" + std::string(list) + "]";
        if (line.starts_with(once) || line.starts_with("[" + once + "]"))
            return "; each of several is written [" + once + "]";
    }
    return {};
}

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
        throw InputError({path, at.line, at.column}, message + hint_for(line_of(text, at.line), message));
    }
}

}  // namespace burin
