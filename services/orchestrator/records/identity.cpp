// Ids begin with the time, so that their order is the order of creation and a list needs no
// further index.
#include "services/orchestrator/records/identity.hpp"

#include <array>
#include <cstdio>
#include <ctime>
#include <random>

namespace breach::orchestrator {

namespace {

constexpr char digits[] = "0123456789abcdefghjkmnpqrstvwxyz";  // Crockford's base 32, lower case

}  // namespace

std::string new_run_id() {
    thread_local std::random_device entropy;
    std::string id(26, '0');
    auto time = static_cast<std::uint64_t>(epoch_ms());
    for (std::size_t i = 10; i-- > 0; time /= 32) id[i] = digits[time % 32];
    std::uniform_int_distribution<std::size_t> any_digit(0, 31);
    for (std::size_t i = 10; i < id.size(); ++i) id[i] = digits[any_digit(entropy)];
    return id;
}

/// Five digits keep ids in order up to 100,000 tasks of a run.
std::string task_id(const std::string& run, std::size_t ordinal) {
    std::array<char, 32> number{};
    std::snprintf(number.data(), number.size(), "-%05zu", ordinal);
    return run + number.data();
}

std::string attempt_id(const std::string& task, std::int64_t number) {
    return task + "." + std::to_string(number);
}

std::string utc_now() { return utc_text(epoch_ms()); }

std::string utc_days_ago(double days) {
    constexpr double ms_of_a_day = 86400e3;
    return utc_text(epoch_ms() - static_cast<std::int64_t>(days * ms_of_a_day));
}

std::string utc_text(std::int64_t now) {
    const std::time_t seconds = now / 1000;
    std::tm utc{};
    gmtime_r(&seconds, &utc);
    std::array<char, 32> date{};
    std::strftime(date.data(), date.size(), "%Y-%m-%dT%H:%M:%S", &utc);
    std::array<char, 8> fraction{};
    std::snprintf(fraction.data(), fraction.size(), ".%03dZ", static_cast<int>(now % 1000));
    return std::string(date.data()) + fraction.data();
}

std::int64_t epoch_ms() {
    return std::chrono::duration_cast<std::chrono::milliseconds>(
               std::chrono::system_clock::now().time_since_epoch())
        .count();
}

}  // namespace breach::orchestrator
