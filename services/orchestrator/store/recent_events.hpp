// The newest events as the writer committed them: hundreds of listeners can read an event without a database
// query each.
#pragma once

#include <deque>
#include <optional>
#include <vector>

#include "services/orchestrator/records/records.hpp"

namespace breach::orchestrator {

class RecentEvents {
  public:
    /// committed: in the order of their numbers, after all that came before.
    void add(std::vector<Event> committed);
    /// To call when some of these events were removed from the database.
    void forget() { kept_.clear(); }
    /// At most so many of those after `seq`. Nothing: some of them may be older than those kept.
    std::optional<std::vector<Event>> after(std::int64_t seq, std::size_t most) const;

  private:
    std::deque<Event> kept_;
};

}  // namespace breach::orchestrator
