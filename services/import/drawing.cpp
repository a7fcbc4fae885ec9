#include "services/import/drawing.hpp"

#include <cmath>
#include <cstdint>
#include <cstdio>
#include <string_view>

namespace breach::importing {

namespace {

std::string digits(const char* format, double value) {
    char buffer[32];
    std::snprintf(buffer, sizeof buffer, format, value == 0.0 ? 0.0 : value);
    return buffer;
}

/// A millimetre is enough for a place, unless it is far away.
std::string coordinate(double value) {
    return digits("%.10g", std::abs(value) < 1e9 ? std::round(1e3 * value) / 1e3 : value);
}

/// Bytes of the UTF-8 character that begins here; 0: it is none.
std::size_t length_at(std::string_view text, std::size_t at) {
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
    const std::uint8_t second = byte(at + 1);  // overlong, surrogates, beyond the last code point
    if ((first == 0xE0 && second < 0xA0) || (first == 0xED && second >= 0xA0) ||
        (first == 0xF0 && second < 0x90) || (first == 0xF4 && second >= 0x90))
        return 0;
    return length;
}

}  // namespace

std::string at_line(std::size_t line) { return "line " + std::to_string(line); }

std::string named(const Outline& outline) {
    return outline.origin.entity + " on layer " + outline.layer;
}

std::string text(const Vec2& place) {
    return "(" + coordinate(place.x()) + ", " + coordinate(place.y()) + ")";
}

std::string metres(double length) { return digits("%.3g", length) + " m"; }

std::string extent(double length) {
    return length < 100.0 ? metres(length) : std::to_string(std::lround(length)) + " m";
}

std::string square_metres(double area) {
    return digits(std::abs(area) < 1.0 ? "%.2g" : "%.6g", area) + " m2";
}

std::string as_utf8(std::string_view bytes) {
    std::string result;
    for (std::size_t at = 0; at < bytes.size();) {
        const std::size_t length = length_at(bytes, at);
        if (length > 0) {
            result += bytes.substr(at, length);
            at += length;
        } else {
            const auto byte = static_cast<std::uint8_t>(bytes[at++]);
            result += static_cast<char>(0xC0 | (byte >> 6));
            result += static_cast<char>(0x80 | (byte & 0x3F));
        }
    }
    return result;
}

std::string lower(std::string text) {
    for (char& each : text)
        if (each >= 'A' && each <= 'Z') each = static_cast<char>(each - 'A' + 'a');
    return text;
}

}  // namespace breach::importing
