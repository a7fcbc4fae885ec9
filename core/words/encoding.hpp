// The encoding of a text that should be UTF-8.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace breach::words {

/// Bytes of the UTF-8 character at this place; 0: none.
inline std::size_t utf8_length(std::string_view text, std::size_t at) {
    const auto byte = [&](std::size_t i) { return static_cast<std::uint8_t>(text[i]); };
    const std::uint8_t first = byte(at);
    const std::size_t length = first < 0x80                     ? 1
                               : first >= 0xC2 && first < 0xE0  ? 2
                               : first >= 0xE0 && first < 0xF0  ? 3
                               : first >= 0xF0 && first <= 0xF4 ? 4
                                                                : 0;
    if (length == 0 || at + length > text.size()) return 0;
    for (std::size_t i = 1; i < length; ++i)
        if ((byte(at + i) & 0xC0) != 0x80) return 0;
    if (length < 3) return length;
    // excludes overlong forms, surrogates, beyond U+10FFFF
    const std::uint8_t second = byte(at + 1);
    if ((first == 0xE0 && second < 0xA0) || (first == 0xED && second >= 0xA0) ||
        (first == 0xF0 && second < 0x90) || (first == 0xF4 && second >= 0x90))
        return 0;
    return length;
}

/// The first byte that is not UTF-8; npos: none.
inline std::size_t first_not_utf8(std::string_view text) {
    for (std::size_t at = 0; at < text.size();) {
        if (static_cast<std::uint8_t>(text[at]) < 0x80) {  // most texts have nothing else
            ++at;
            continue;
        }
        const std::size_t length = utf8_length(text, at);
        if (length == 0) return at;
        at += length;
    }
    return std::string_view::npos;
}

/// "UTF-16" or "UTF-32" (names of iconv), from the byte order mark or the zero bytes of a leading
/// ASCII character; empty for all others.
inline std::string wide_encoding(std::string_view text) {
    const std::string_view four = text.substr(0, 4);
    using namespace std::string_view_literals;
    if (four == "\xFF\xFE\0\0"sv || four == "\0\0\xFE\xFF"sv) return "UTF-32";
    if (four.starts_with("\xFF\xFE") || four.starts_with("\xFE\xFF")) return "UTF-16";
    if (four.size() < 2) return "";
    std::string zeros;
    for (const char each : four) zeros += each == '\0' ? '0' : 'x';
    if (zeros == "x000") return "UTF-32LE";
    if (zeros == "000x") return "UTF-32BE";
    if (zeros == "x0x0" || zeros == "x0") return "UTF-16LE";
    if (zeros == "0x0x" || zeros == "0x") return "UTF-16BE";
    return "";
}

/// "save it as UTF-8 (iconv -f UTF-16 -t UTF-8 FILE)"
inline std::string as_utf8_remedy(const std::string& encoding) {
    return "save it as UTF-8 (iconv -f " + encoding + " -t UTF-8 FILE)";
}

}  // namespace breach::words
