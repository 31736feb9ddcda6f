#include "mesh/ply_header.h"

#include <algorithm>
#include <utility>

#include "mesh/text_scan.h"

namespace burin {
namespace {

constexpr std::size_t kMaxHeaderLines = 10000;

bool parse_type(std::string_view word, PlyType& type) {
    static constexpr std::pair<std::string_view, PlyType> kNames[] = {
        {"char", PlyType::int8},     {"int8", PlyType::int8},       {"uchar", PlyType::uint8},
        {"uint8", PlyType::uint8},   {"short", PlyType::int16},     {"int16", PlyType::int16},
        {"ushort", PlyType::uint16}, {"uint16", PlyType::uint16},   {"int", PlyType::int32},
        {"int32", PlyType::int32},   {"uint", PlyType::uint32},     {"uint32", PlyType::uint32},
        {"float", PlyType::float32}, {"float32", PlyType::float32}, {"double", PlyType::float64},
        {"float64", PlyType::float64}};
    for (const auto& [name, value] : kNames) {
        if (name == word) {
            type = value;
            return true;
        }
    }
    return false;
}

class HeaderParser {
  public:
    HeaderParser(const std::string& path, std::string_view bytes)
        : path_(path), bytes_(bytes), lines_(bytes) {}

    PlyHeader parse() {
        std::string_view line;
        if (!lines_.next(line) || LineScanner(line).rest() != "ply") {
            fail("this is no PLY file (it does not start with 'ply')");
        }
        bool has_format = false;
        while (true) {
            if (!lines_.next(line) || lines_.line_number() > kMaxHeaderLines) {
                fail("the header has no 'end_header' line; was the file written completely?");
            }
            LineScanner scan(line);
            const std::string_view keyword = scan.word();
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
        header_.size = bytes_.size() - lines_.rest().size();
        header_.lines = lines_.line_number();
        return std::move(header_);
    }

  private:
    [[noreturn]] void fail(const std::string& message) const {
        throw InputError({path_, std::max<std::size_t>(1, lines_.line_number())}, message);
    }

    void parse_format(LineScanner& scan) {
        const std::string_view name = scan.word();
        if (name == "ascii") {
            header_.encoding = PlyEncoding::ascii;
        } else if (name == "binary_little_endian") {
            header_.encoding = PlyEncoding::little_endian;
        } else if (name == "binary_big_endian") {
            header_.encoding = PlyEncoding::big_endian;
        } else {
            fail("unknown format '" + printable(name) +
                 "'; expected ascii, binary_little_endian or binary_big_endian");
        }
    }

    void parse_element(LineScanner& scan) {
        PlyElement element;
        element.name = scan.word();
        std::int64_t count = 0;
        if (element.name.empty() || !scan.integer(count) || count < 0) {
            fail("an element needs a name and a count of 0 or more; repair the file");
        }
        element.count = static_cast<std::uint64_t>(count);
        header_.elements.push_back(std::move(element));
    }

    void parse_property(LineScanner& scan) {
        if (header_.elements.empty()) fail("a property stands before any element; repair the file");
        PlyProperty property;
        std::string_view type = scan.word();
        if (type == "list") {
            property.is_list = true;
            const std::string_view count_type = scan.word();
            if (!parse_type(count_type, property.count_type) ||
                property.count_type >= PlyType::float32) {
                fail("'" + printable(count_type) + "' cannot count a list; repair the file");
            }
            type = scan.word();
        }
        if (!parse_type(type, property.type)) {
            fail("unknown property type '" + printable(type) + "'; repair the file");
        }
        property.name = scan.word();
        if (property.name.empty()) fail("a property needs a name; repair the file");
        header_.elements.back().properties.push_back(std::move(property));
    }

    const std::string& path_;
    std::string_view bytes_;
    LineReader lines_;
    PlyHeader header_;
};

}  // namespace

int PlyElement::find(std::string_view name_a, std::string_view name_b) const {
    for (std::size_t i = 0; i < properties.size(); ++i) {
        const std::string& property = properties[i].name;
        if (property == name_a || (!name_b.empty() && property == name_b)) return static_cast<int>(i);
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

PlyHeader read_ply_header(const std::string& path, std::string_view bytes) {
    return HeaderParser(path, bytes).parse();
}

}  // namespace burin
