#include "services/orchestrator/http/wire.hpp"

#include <arpa/inet.h>
#include <fcntl.h>
#include <openssl/err.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>

namespace breach::orchestrator {

namespace {

std::chrono::milliseconds whole_ms(Wire::Clock::duration time) {
    return std::max(std::chrono::milliseconds(0),
                    std::chrono::ceil<std::chrono::milliseconds>(time));
}

/// What a pace of so many bytes a second has earned.
Wire::Clock::duration earned(double bytes, double rate) {
    return std::chrono::duration_cast<Wire::Clock::duration>(
        std::chrono::duration<double>(bytes / rate));
}

void tell_address(const sockaddr_storage& address, std::string& ip, int& port) {
    std::array<char, INET6_ADDRSTRLEN> text{};
    if (address.ss_family == AF_INET) {
        const auto* v4 = reinterpret_cast<const sockaddr_in*>(&address);
        inet_ntop(AF_INET, &v4->sin_addr, text.data(), text.size());
        port = ntohs(v4->sin_port);
    } else if (address.ss_family == AF_INET6) {
        const auto* v6 = reinterpret_cast<const sockaddr_in6*>(&address);
        inet_ntop(AF_INET6, &v6->sin6_addr, text.data(), text.size());
        port = ntohs(v6->sin6_port);
    }
    ip = text.data();
}

}  // namespace

Wire::Wire(int socket, Certificates::Context context, Patience patience)
    : socket_(socket), context_(std::move(context)), tls_(nullptr, SSL_free), patience_(patience) {
    fcntl(socket_, F_SETFL, fcntl(socket_, F_GETFL) | O_NONBLOCK);
    if (!context_) return;
    tls_.reset(SSL_new(context_.get()));
    if (tls_ == nullptr || SSL_set_fd(tls_.get(), socket_) != 1) broken_ = true;
}

/// Says that nothing more comes, and hears for a moment what the client still has to say: closing a socket with unread
/// bytes would take the answer away from a client that has not read it yet.
Wire::~Wire() {
    if (tls_ != nullptr && !broken_ && SSL_is_init_finished(tls_.get())) SSL_shutdown(tls_.get());
    ::shutdown(socket_, SHUT_WR);
    if (!broken_) {
        constexpr auto moment = std::chrono::milliseconds(500);
        constexpr int most_reads = 64;
        const auto until = Clock::now() + moment;
        for (int i = 0; i < most_reads && wait_for(POLLIN, until); ++i)
            if (::recv(socket_, buffer_.data(), buffer_.size(), 0) <= 0) break;
    }
    ::close(socket_);
}

bool Wire::wait_for(short event, Clock::time_point until) const {
    pollfd wanted{socket_, event, 0};
    while (true) {
        const int ready =
            ::poll(&wanted, 1, static_cast<int>(whole_ms(until - Clock::now()).count()));
        if (ready > 0) return (wanted.revents & (event | POLLHUP)) != 0;
        if (ready == 0 || errno != EINTR) return false;
    }
}

/// After a call of OpenSSL that did not get through: whether it may be repeated.
bool Wire::wait_as_tls_wants(int result, Clock::time_point until) const {
    switch (SSL_get_error(tls_.get(), result)) {
        case SSL_ERROR_WANT_READ:
            return wait_for(POLLIN, until);
        case SSL_ERROR_WANT_WRITE:
            return wait_for(POLLOUT, until);
        default:
            return false;
    }
}

bool Wire::shake_hands() {
    if (broken_ || tls_ == nullptr) return !broken_;
    const auto until = Clock::now() + patience_.patience;
    while (true) {
        ERR_clear_error();
        const int result = SSL_accept(tls_.get());
        if (result == 1) return true;
        if (!wait_as_tls_wants(result, until)) {
            broken_ = true;
            return false;
        }
    }
}

bool Wire::waits_to_be_read(std::chrono::milliseconds longest) {
    if (from_ < to_ || (tls_ != nullptr && SSL_pending(tls_.get()) > 0)) return true;
    return wait_for(POLLIN, Clock::now() + longest);
}

void Wire::expect_head() {
    is_head_ = true;
    begun_ = Clock::now();
    sent_ = received_ = 0.0;
    blocked_ = {};
}

void Wire::expect_body() {
    is_head_ = false;
    begun_ = Clock::now();
}

bool Wire::is_readable() const {
    return from_ < to_ || (tls_ != nullptr && SSL_pending(tls_.get()) > 0) ||
           wait_for(POLLIN, Clock::now() + patience_.patience);
}

/// Asked between two parts of an answer that is made as it goes: also whether anybody is still there.
bool Wire::is_writable() const {
    const auto before = Clock::now();
    const bool free = !broken_ && wait_for(POLLOUT, before + left_to_write());
    blocked_ += Clock::now() - before;
    if (!free) return false;
    char next = 0;
    const ssize_t seen = ::recv(socket_, &next, 1, MSG_PEEK | MSG_DONTWAIT);
    return seen > 0 || (seen < 0 && (errno == EAGAIN || errno == EWOULDBLOCK));
}

ssize_t Wire::receive(char* data, std::size_t size) {
    const auto allowed = patience_.patience +
                         (is_head_ ? Clock::duration{} : earned(received_, patience_.least_rate));
    const auto until =
        std::min<Clock::time_point>(begun_ + allowed, Clock::now() + patience_.patience);
    while (!broken_) {
        if (tls_ != nullptr) {
            ERR_clear_error();
            const int got = SSL_read(tls_.get(), data, static_cast<int>(size));
            if (got > 0) return got;
            if (SSL_get_error(tls_.get(), got) == SSL_ERROR_ZERO_RETURN) return 0;
            if (!wait_as_tls_wants(got, until)) break;
        } else {
            const ssize_t got = ::recv(socket_, data, size, 0);
            if (got >= 0) return got;
            if (errno != EAGAIN && errno != EWOULDBLOCK && errno != EINTR) break;
            if (!wait_for(POLLIN, until)) break;
        }
    }
    return -1;
}

ssize_t Wire::read(char* data, std::size_t size) {
    if (from_ == to_) {
        const ssize_t got = receive(buffer_.data(), buffer_.size());
        if (got <= 0) return got;
        received_ += static_cast<double>(got);
        from_ = 0;
        to_ = static_cast<std::size_t>(got);
    }
    const std::size_t count = std::min(size, to_ - from_);
    std::memcpy(data, buffer_.data() + from_, count);
    from_ += count;
    return static_cast<ssize_t>(count);
}

Wire::Clock::duration Wire::left_to_write() const {
    const Clock::duration in_all =
        patience_.patience + earned(sent_, patience_.least_rate) - blocked_;
    return std::min<Clock::duration>(in_all, patience_.patience);
}

ssize_t Wire::write(const char* data, std::size_t size) {
    while (!broken_) {
        ssize_t done = 0;
        const auto before = Clock::now();
        const auto until = before + left_to_write();
        if (tls_ != nullptr) {
            ERR_clear_error();
            done =
                SSL_write(tls_.get(), data, static_cast<int>(std::min<std::size_t>(size, 1 << 20)));
            if (done <= 0 && !wait_as_tls_wants(static_cast<int>(done), until)) break;
        } else {
            done = ::send(socket_, data, size, MSG_NOSIGNAL);
            if (done < 0 && errno != EINTR &&
                ((errno != EAGAIN && errno != EWOULDBLOCK) || !wait_for(POLLOUT, until)))
                break;
        }
        if (done > 0) {
            sent_ += static_cast<double>(done);
            return done;
        }
        blocked_ += Clock::now() - before;
    }
    broken_ = true;
    return -1;
}

void Wire::get_remote_ip_and_port(std::string& ip, int& port) const {
    sockaddr_storage address{};
    socklen_t size = sizeof address;
    if (getpeername(socket_, reinterpret_cast<sockaddr*>(&address), &size) == 0)
        tell_address(address, ip, port);
}

void Wire::get_local_ip_and_port(std::string& ip, int& port) const {
    sockaddr_storage address{};
    socklen_t size = sizeof address;
    if (getsockname(socket_, reinterpret_cast<sockaddr*>(&address), &size) == 0)
        tell_address(address, ip, port);
}

}  // namespace breach::orchestrator
