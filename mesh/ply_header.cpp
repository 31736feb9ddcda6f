#include "mesh/ply_header.h"

#include <algorithm>
#include <optional>
#include <utility>

#include "mesh/text_scan.h"

namespace burin {
namespace {

constexpr std::size_t kMaxHeaderLines = 10000;

/// The type of a name as it stands in any case, also with the _t of C's names behind it.
std::optional<PlyType> type_of(std::string_view word) {
    static constexpr std::pair<std::string_view, PlyType> kNames[] = {
        {"char", PlyType::int8},      {"int8", PlyType::int8},      {"uchar", PlyType::uint8},
        {"uint8", PlyType::uint8},    {"short", PlyType::int16},    {"int16", PlyType::int16},
        {"ushort", PlyType::uint16},  {"uint16", PlyType::uint16},  {"int", PlyType::int32},
        {"int32", PlyType::int32},    {"uint", PlyType::uint32},    {"uint32", PlyType::uint32},
        {"longlong", PlyType::int64}, {"int64", PlyType::int64},    {"ulonglong", PlyType::uint64},
        {"uint64", PlyType::uint64},  {"float", PlyType::float32},  {"float32", PlyType::float32},
        {"double", PlyType::float64}, {"float64", PlyType::float64}};
    std::string name = lower_case(word);
    if (name.ends_with("_t")) name.resize(name.size() - 2);
    for (const auto& [known, value] : kNames) {
        if (known == name) return value;
    }
    return std::nullopt;
}

class HeaderParser {
  public:
    HeaderParser(const std::string& path, std::string_view bytes) : path_(path), bytes_(bytes), lines_(bytes) {}

    PlyHeader parse() {
        std::string_view line;
        if (!lines_.next(line) || lower_case(LineScanner(line).rest()) != "ply") {
            fail("this is no PLY file (it does not start with 'ply')");
        }
        const char* const first_line_end = line.data() + line.size();
        bool has_format = false;
        while (true) {
            if (!lines_.next(line) || lines_.line_number() > kMaxHeaderLines) {
                fail("the header has no 'end_header' line; was the file written completely?");
            }
            LineScanner scan(line);
            const std::string keyword = lower_case(scan.word());
            if (keyword == "format") {
                parse_format(scan);
                has_format = true;
            } else if (keyword == "element") {
                parse_element(scan);
            } else if (keyword == "property") {
                parse_property(scan);
            } else if (keyword == "end_header") {
                break;
            }
            // Everything else is a comment; some writers forget the word.
        }
        if (!has_format) fail("the header has no 'format' line; repair the file");
        check_types();
        header_.size = bytes_.size() - lines_.rest().size();
        const char* const end = bytes_.data() + bytes_.size();
        if (first_line_end < end && is_lone_carriage_return(first_line_end, end) &&
            header_.encoding != PlyEncoding::ascii) {
            // Lines of this header end in CR alone: an LF behind the last one is the first byte of
            // a binary body.
            header_.size = static_cast<std::size_t>(line.data() + line.size() - bytes_.data()) + 1;
        }
        header_.lines = lines_.line_number();
        return std::move(header_);
    }

  private:
    [[noreturn]] void fail(const std::string& message) const {
        throw InputError({path_, std::max<std::size_t>(1, lines_.line_number())}, message);
    }

    void parse_format(LineScanner& scan) {
        const std::string name = lower_case(scan.word());
        if (name == "ascii") {
            header_.encoding = PlyEncoding::ascii;
        } else if (name == "binary_little_endian") {
            header_.encoding = PlyEncoding::little_endian;
        } else if (name == "binary_big_endian") {
            header_.encoding = PlyEncoding::big_endian;
        } else {
            fail("unknown format '" + printable(name) + "'; expected ascii, binary_little_endian or binary_big_endian");
        }
    }

    void parse_element(LineScanner& scan) {
        PlyElement element;
        element.name = lower_case(scan.word());
        std::int64_t count = 0;
        if (element.name.empty() || !scan.integer(count) || count < 0) {
            fail("an element needs a name and a count of 0 or more; repair the file");
        }
        element.count = static_cast<std::uint64_t>(count);
        header_.elements.push_back(std::move(element));
    }

    PlyType parse_type(std::string_view word) {
        if (const std::optional<PlyType> type = type_of(word)) return *type;
        const std::string name = lower_case(word);
        if (name != "long" && name != "ulong") fail("unknown property type '" + printable(word) + "'; repair the file");
        if (line_of_long_ == 0) line_of_long_ = lines_.line_number();
        return name == "long" ? PlyType::int64 : PlyType::uint64;
    }
    /// `long` has 4 bytes or 8, depending on where the file was written; text does not mind.
    void check_types() const {
        if (line_of_long_ == 0 || header_.encoding == PlyEncoding::ascii) return;
        throw InputError({path_, line_of_long_},
                         "the type 'long' has 4 bytes on some machines and 8 on others; write "
                         "int32 or int64 instead");
    }

    void parse_property(LineScanner& scan) {
        if (header_.elements.empty()) fail("a property stands before any element; repair the file");
        PlyProperty property;
        std::string_view type = scan.word();
        if (lower_case(type) == "list") {
            property.is_list = true;
            const std::string_view count_type = scan.word();
            property.count_type = parse_type(count_type);
            if (property.count_type >= PlyType::float32)
                fail("'" + printable(count_type) + "' cannot count a list; repair the file");
            type = scan.word();
        }
        property.type = parse_type(type);
        property.name = scan.word();
        if (property.name.empty()) fail("a property needs a name; repair the file");
        header_.elements.back().properties.push_back(std::move(property));
    }

    const std::string& path_;
    std::string_view bytes_;
    LineReader lines_;
    PlyHeader header_;
    std::size_t line_of_long_ = 0;  // the first one of a type with that name
};

}  // namespace

int PlyElement::find(std::string_view name_a, std::string_view name_b) const {
    for (const bool any_case : {false, true}) {
        for (std::size_t i = 0; i < properties.size(); ++i) {
            const std::string property = any_case ? lower_case(properties[i].name) : properties[i].name;
            if (property == name_a || (!name_b.empty() && property == name_b)) return static_cast<int>(i);
        }
    }
    return -1;
}

bool PlyElement::has_lists() const {
    return std::any_of(properties.begin(), properties.end(), [](const PlyProperty& p) { return p.is_list; });
}

std::uint64_t PlyElement::smallest_binary_size() const {
    std::uint64_t size = 0;
    for (const PlyProperty& p : properties) size += size_of(p.is_list ? p.count_type : p.type);
    return size;
}

PlyHeader read_ply_header(const std::string& path, std::string_view bytes) { return HeaderParser(path, bytes).parse(); }

}  // namespace burin
