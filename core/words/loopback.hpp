// Decides whether an address names this machine only. One rule for the service and its clients.
#pragma once

#include <arpa/inet.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <string>
#include <string_view>

namespace breach::words {

/// True for "localhost" (any case), a dotted quad 127.x.y.z, the IPv6 address ::1 and IPv6 forms of
/// 127.x.y.z. A name or quad may end in one dot. False for every other text: a name that only
/// begins like an address belongs to someone else.
inline bool is_loopback(std::string_view host) {
    std::string name(host);
    for (char& c : name) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    if (name.find('\0') != std::string::npos) return false;  // inet_pton would stop there
    std::array<unsigned char, 16> bytes{};
    if (inet_pton(AF_INET6, name.c_str(), bytes.data()) == 1) {
        constexpr std::array<unsigned char, 16> one{0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 1};
        constexpr std::array<unsigned char, 13> mapped{0, 0, 0, 0,    0,    0,  0,
                                                       0, 0, 0, 0xFF, 0xFF, 127};
        return bytes == one || std::equal(mapped.begin(), mapped.end(), bytes.begin());
    }
    if (name.ends_with('.')) name.pop_back();
    return name == "localhost" ||
           (inet_pton(AF_INET, name.c_str(), bytes.data()) == 1 && bytes[0] == 127);
}

/// The same for "host" or "host:port" as in a URL or a Host header: IPv6 in brackets, the port a
/// number. False if there is anything else, such as a user.
inline bool is_loopback_authority(std::string_view authority) {
    const bool brackets = authority.starts_with('[');
    const std::size_t end =
        brackets ? authority.find(']') : std::min(authority.find(':'), authority.size());
    if (end == std::string_view::npos) return false;
    const std::string_view host = authority.substr(brackets, end - brackets);
    const std::string_view behind = authority.substr(end + brackets);
    const bool sound =
        behind.empty() || (behind.front() == ':' && behind.size() >= 2 && behind.size() <= 6 &&
                           behind.find_first_not_of("0123456789", 1) == std::string_view::npos);
    return sound && brackets == (host.find(':') != std::string_view::npos) && is_loopback(host);
}

}  // namespace breach::words
