// Words for places, lengths and entities in messages. One form for all readers: the drawing of
// faults finds places by it.
#include "services/import/drawing.hpp"

#include <cmath>
#include <cstdint>
#include <cstdio>
#include <string_view>

#include "core/words/encoding.hpp"

namespace breach::importing {

namespace {

/// A negative zero prints as 0.
std::string digits(const char* format, double value) {
    char buffer[32];
    std::snprintf(buffer, sizeof buffer, format, value == 0.0 ? 0.0 : value);
    return buffer;
}

/// To a millimetre, unless the value is large.
/// Millimetres are finer than any survey. Beyond 1e9 the factor 1e3 would only add digits of noise.
std::string coordinate(double value) {
    return digits("%.10g", std::abs(value) < 1e9 ? std::round(1e3 * value) / 1e3 : value);
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

/// Whole metres from 100 m on: such a length tells a wrong unit, no more.
std::string extent(double length) {
    return length < 100.0 ? metres(length) : std::to_string(std::lround(length)) + " m";
}

std::string square_metres(double area) {
    return digits(std::abs(area) < 1.0 ? "%.2g" : "%.6g", area) + " m2";
}

/// Older DXF files are in a code page of their own, which is read as Latin-1.
std::string as_utf8(std::string_view bytes) {
    std::string result;
    for (std::size_t at = 0; at < bytes.size();) {
        const std::size_t length = words::utf8_length(bytes, at);
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

/// ASCII only: layers with other letters compare as they are.
std::string lower(std::string text) {
    for (char& each : text)
        if (each >= 'A' && each <= 'Z') each = static_cast<char>(each - 'A' + 'a');
    return text;
}

}  // namespace breach::importing
