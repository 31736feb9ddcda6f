#include "output/pdf_file.h"

#include <cstdint>
#include <cstdio>

#include "image/deflate.h"
#include "output/utf8.h"
#include "shading/ink/line_random.h"

namespace burin {
namespace {

std::string hex(std::uint64_t bits, int digits) {
    std::string text;
    for (int shift = 4 * (digits - 1); shift >= 0; shift -= 4) text += "0123456789ABCDEF"[bits >> shift & 15];
    return text;
}

std::string compressed(std::string_view bytes) {
    Deflater deflater;
    const auto out = deflater.compress({reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size()});
    return {reinterpret_cast<const char*>(out.data()), out.size()};
}

}  // namespace

std::size_t PdfFile::add_stream(std::string_view bytes, const std::string& entries, bool is_compressed) {
    const std::string data = is_compressed ? compressed(bytes) : std::string(bytes);
    std::string object = "<< " + entries + (entries.empty() ? "" : " ");
    if (is_compressed) object += "/Filter /FlateDecode ";
    object += "/Length " + std::to_string(data.size()) + " >>\nstream\n" + data + "\nendstream";
    return add(std::move(object));
}

std::string PdfFile::text(int minor_version, std::size_t root, std::size_t info) const {
    // Bytes above 127 tell programs that the file is no text.
    std::string out = "%PDF-1." + std::to_string(minor_version) + "\n%\xE2\xE3\xCF\xD3\n";
    std::string table = "xref\n0 " + std::to_string(objects_.size() + 1) + "\n0000000000 65535 f \n";
    LineHash hash;
    for (std::size_t i = 0; i < objects_.size(); ++i) {
        char place[32];
        std::snprintf(place, sizeof place, "%010zu 00000 n \n", out.size());
        table += place;
        out += std::to_string(i + 1) + " 0 obj\n" + objects_[i] + "\nendobj\n";
        hash.add(std::string_view(objects_[i]));
    }
    const std::size_t begin = out.size();
    const std::string id = hex(hash.bits(), 16) + hex(LineHash(hash.bits()).bits(), 16);
    out += table + "trailer\n<< /Size " + std::to_string(objects_.size() + 1) + " /Root " + reference(root) +
           " /Info " + reference(info) + " /ID [<" + id + "> <" + id + ">] >>\nstartxref\n" + std::to_string(begin) +
           "\n%%EOF\n";
    return out;
}

std::string PdfFile::text_string(std::string_view utf8) {
    bool is_plain = true;
    for (const char c : utf8) is_plain = is_plain && c >= ' ' && c <= '~';
    std::string out;
    if (is_plain) {
        out = "(";
        for (const char c : utf8) {
            if (c == '(' || c == ')' || c == '\\') out += '\\';
            out += c;
        }
        return out + ")";
    }
    out = "<FEFF";
    while (!utf8.empty()) {
        Utf8Character c = first_character(utf8);
        if (c.code == 0) c.code = 0xFFFD;
        if (c.code < 0x10000) {
            out += hex(c.code, 4);
        } else {
            out += hex(0xD800 + ((c.code - 0x10000) >> 10), 4) + hex(0xDC00 + ((c.code - 0x10000) & 0x3FF), 4);
        }
        utf8.remove_prefix(c.bytes);
    }
    return out + ">";
}

}  // namespace burin
