// One client's connection, plain or TLS, with a clock: whoever sends or reads too slowly is cut off, so that no client
// holds a thread for longer than its request is worth.
#pragma once

#include <httplib.h>
#undef _res  // of <resolv.h>: Eigen has parameters of that name

#include <array>
#include <chrono>
#include <memory>

#include "services/orchestrator/http/certificates.hpp"
#include "services/orchestrator/http/patience.hpp"

namespace breach::orchestrator {

class Wire : public httplib::Stream {
  public:
    using Clock = std::chrono::steady_clock;

    /// Takes the socket. context: null: plain.
    Wire(int socket, Certificates::Context context, Patience patience);
    ~Wire() override;
    Wire(const Wire&) = delete;
    Wire& operator=(const Wire&) = delete;

    bool shake_hands();
    /// Something came, or is left from before, within this time.
    bool waits_to_be_read(std::chrono::milliseconds longest);
    void expect_head();
    void expect_body();

    bool is_readable() const override;
    bool is_writable() const override;
    ssize_t read(char* data, std::size_t size) override;
    ssize_t write(const char* data, std::size_t size) override;
    void get_remote_ip_and_port(std::string& ip, int& port) const override;
    void get_local_ip_and_port(std::string& ip, int& port) const override;
    socket_t socket() const override { return socket_; }

  private:
    ssize_t receive(char* data, std::size_t size);
    bool wait_for(short event, Clock::time_point until) const;
    bool wait_as_tls_wants(int result, Clock::time_point until) const;
    Clock::duration left_to_write() const;

    int socket_;
    Certificates::Context context_;
    std::unique_ptr<SSL, decltype(&SSL_free)> tls_;
    Patience patience_;
    std::array<char, 16384> buffer_{};
    std::size_t from_ = 0, to_ = 0;  ///< what of the buffer is not read yet
    bool broken_ = false;
    bool is_head_ = true;
    Clock::time_point begun_ = Clock::now();
    double received_ = 0.0;              ///< of this body [bytes]
    double sent_ = 0.0;                  ///< of this answer [bytes]
    mutable Clock::duration blocked_{};  ///< that the client let us wait for it
};

}  // namespace breach::orchestrator
