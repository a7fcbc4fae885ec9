// The newest events, for those who follow the stream. Store::commit adds under its lock and
// forgets all when a run is removed, because events of removed runs must not be sent any more.
#include "services/orchestrator/store/recent_events.hpp"

#include <algorithm>
#include <iterator>

namespace breach::orchestrator {

namespace {

/// A client that is further behind reads the database.
constexpr std::size_t most_kept = 1000;

}  // namespace

void RecentEvents::add(std::vector<Event> committed) {
    std::ranges::move(committed, std::back_inserter(kept_));
    if (kept_.size() > most_kept)
        kept_.erase(kept_.begin(), kept_.end() - static_cast<std::ptrdiff_t>(most_kept));
}

std::optional<std::vector<Event>> RecentEvents::after(std::int64_t seq, std::size_t most) const {
    // Nothing: events are missing between seq and the first kept one, so the database must
    // answer.
    if (kept_.empty() || seq + 1 < kept_.front().seq) return std::nullopt;
    const auto first = std::ranges::upper_bound(kept_, seq, {}, &Event::seq);
    const auto count = std::min(most, static_cast<std::size_t>(kept_.end() - first));
    return std::vector<Event>(first, first + static_cast<std::ptrdiff_t>(count));
}

}  // namespace breach::orchestrator
