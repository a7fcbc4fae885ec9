// The newest committed events, so that hundreds of listeners can read an event without a database
// query each.
#pragma once

#include <deque>
#include <optional>
#include <vector>

#include "services/orchestrator/records/records.hpp"

namespace breach::orchestrator {

class RecentEvents {
  public:
    /// committed: the next events in the order of their numbers.
    void add(std::vector<Event> committed);
    /// Call when some of these events were removed from the database.
    void forget() { kept_.clear(); }
    /// At most `most` of the events after `seq`. Nothing: some of them may be older than those
    /// kept.
    std::optional<std::vector<Event>> after(std::int64_t seq, std::size_t most) const;

  private:
    std::deque<Event> kept_;
};

}  // namespace breach::orchestrator
