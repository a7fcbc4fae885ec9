// httplib's server with connections of our own (Wire), so many threads and so many clients that wait for one: who comes
// on top is told so at once.
#pragma once

#include <atomic>
#include <deque>
#include <memory>
#include <thread>

#include "services/orchestrator/http/wire.hpp"

namespace breach::orchestrator {

class Listener : public httplib::Server {
  public:
    /// certificates: null: plain HTTP.
    Listener(std::unique_ptr<Certificates> certificates, Patience patience);
    ~Listener() override;
    Listener(const Listener&) = delete;
    Listener& operator=(const Listener&) = delete;

    /// Until stop(); call it once, after binding.
    void serve();

    static constexpr std::size_t threads =
        256;  ///< one per connection, and streams of events hold theirs
    static constexpr int most_waiting = 256;  ///< connections without a thread

  private:
    bool process_and_close_socket(socket_t socket) override;
    void answer(Wire& wire);
    void turn_away(int socket);

    std::unique_ptr<Certificates> certificates_;
    Patience patience_;
    std::thread::id listening_;
    std::deque<int> turned_away_;  ///< closed when others follow: their clients read first
};

}  // namespace breach::orchestrator
