#include "services/orchestrator/http/listener.hpp"

#include <sys/socket.h>
#include <unistd.h>

#include <array>
#include <string>

namespace breach::orchestrator {

namespace {

constexpr std::size_t most_requests_per_connection = 1000;
constexpr auto idle_between_requests = std::chrono::seconds(5);
constexpr auto look_at_stopping = std::chrono::milliseconds(250);

/// What finds no place is called at once, on the listening thread.
class Pool : public httplib::ThreadPool {
  public:
    Pool() : ThreadPool(Listener::threads) {}
    void enqueue(std::function<void()> job) override {
        if (waiting_.fetch_add(1) >= Listener::most_waiting) {
            waiting_.fetch_sub(1);
            job();
            return;
        }
        ThreadPool::enqueue([this, job = std::move(job)] {
            waiting_.fetch_sub(1);
            job();
        });
    }

  private:
    std::atomic<int> waiting_ = 0;
};

}  // namespace

Listener::Listener(std::unique_ptr<Certificates> certificates, Patience patience)
    : certificates_(std::move(certificates)), patience_(patience) {
    new_task_queue = [] { return new Pool; };
    set_keep_alive_max_count(most_requests_per_connection);
    set_tcp_nodelay(true);
    // Not httplib's default, which lets a second service share the port.
    set_socket_options([](socket_t socket) {
        const int on = 1;
        setsockopt(socket, SOL_SOCKET, SO_REUSEADDR, &on, sizeof on);
    });
}

Listener::~Listener() {
    for (const int each : turned_away_) ::close(each);
}

void Listener::serve() {
    // Debian's httplib listens with a backlog of 5: of fifty clients that knock at once, some would wait a second for
    // their connection, or give up. Linux lets a listening socket's backlog be raised.
    ::listen(svr_sock_, 512);
    listening_ = std::this_thread::get_id();
    listen_after_bind();
}

bool Listener::process_and_close_socket(socket_t socket) {
    if (std::this_thread::get_id() == listening_) {
        turn_away(socket);
        return false;
    }
    Wire wire(socket, certificates_ ? certificates_->newest() : nullptr, patience_);
    if (wire.shake_hands()) answer(wire);
    return true;
}

void Listener::answer(Wire& wire) {
    std::chrono::milliseconds idle = patience_.patience;
    for (std::size_t left = keep_alive_max_count_; left > 0; --left) {
        const auto until = Wire::Clock::now() + idle;
        idle = idle_between_requests;
        while (svr_sock_ != INVALID_SOCKET && !wire.waits_to_be_read(look_at_stopping))
            if (Wire::Clock::now() > until) return;
        if (svr_sock_ == INVALID_SOCKET) return;
        wire.expect_head();
        bool closed = false;
        const bool well = process_request(wire, left == 1, closed,
                                          [&](httplib::Request&) { wire.expect_body(); });
        if (!well || closed) return;
    }
}

/// In plain HTTP it hears why; TLS would take a handshake, for which there is no thread.
void Listener::turn_away(int socket) {
    if (!certificates_) {
        const std::string body =
            R"({"type":"/problems/busy","title":"Too many connections","status":503,"detail":")"
            "all places are taken; try again\"}";
        const std::string answer =
            "HTTP/1.1 503 Service Unavailable\r\nContent-Type: application/problem+json\r\n"
            "Retry-After: 5\r\nConnection: close\r\nContent-Length: " +
            std::to_string(body.size()) + "\r\n\r\n" + body;
        std::array<char, 4096> asked{};
        while (::recv(socket, asked.data(), asked.size(), MSG_DONTWAIT) > 0) {
        }
        ::send(socket, answer.data(), answer.size(), MSG_NOSIGNAL | MSG_DONTWAIT);
    }
    ::shutdown(socket, SHUT_WR);
    constexpr std::size_t most_kept = 64;
    turned_away_.push_back(socket);
    if (turned_away_.size() <= most_kept) return;
    ::close(turned_away_.front());
    turned_away_.pop_front();
}

}  // namespace breach::orchestrator
