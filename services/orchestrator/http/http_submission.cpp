// From a sent study to a stored run; POST /v1/runs and /v1/sweeps call it on their request's
// thread. The answer follows the commit: a client that gets none repeats the request with the
// same Idempotency-Key and receives the first run. The key is stored in the run's transaction, so
// that there is never one without the other.
#include "services/orchestrator/http/http_submission.hpp"

#include <algorithm>
#include <array>

#include "core/exchange/provenance.hpp"
#include "services/orchestrator/http/sent_documents.hpp"
#include "services/orchestrator/study/new_run.hpp"

namespace breach::orchestrator {

using nlohmann::json;

namespace {

/// Two equal requests may arrive at once, before either has stored the key: the second gets 409
/// and asks again. Ends with the request, also by an exception.
class KeyInProgress {
  public:
    KeyInProgress(KeysInProgress& keys, std::string key, httplib::Response& response)
        : keys_(keys), key_(std::move(key)) {
        if (keys_.enter(key_)) return;
        response.set_header("Retry-After", "1");
        throw Problem{409, "/problems/idempotency-in-progress", "In progress",
                      "a request with this Idempotency-Key is being stored; ask again"};
    }
    ~KeyInProgress() { keys_.leave(key_); }
    KeyInProgress(const KeyInProgress&) = delete;
    KeyInProgress& operator=(const KeyInProgress&) = delete;

  private:
    KeysInProgress& keys_;
    std::string key_;
};

std::optional<std::string> idempotency_key(const httplib::Request& request) {
    if (!request.has_header("Idempotency-Key")) return std::nullopt;
    const std::string key = request.get_header_value("Idempotency-Key");
    const bool visible = std::ranges::all_of(key, [](char c) { return c >= '!' && c <= '~'; });
    if (request.get_header_value_count("Idempotency-Key") > 1 || key.empty() || key.size() > 255 ||
        !visible)
        throw bad_request("Idempotency-Key must be one value of 1 to 255 visible ASCII characters");
    return key;
}

std::string stored(Service& service, const Call& call, const std::string& body, Ask ask,
                   const std::function<void(Transaction&, const std::string&)>& besides) {
    NewRun run = new_run(sent_study(body, service), service.numerics);
    if (ask == Ask::sweep) run.sweep = true;
    service.store.write(call.caller.name, [&](Transaction& transaction) {
        transaction.add_run(run);
        besides(transaction, run.id);
    });
    service.dispatcher.wake();
    return run.id;
}

}  // namespace

std::size_t wanted_length(const Call& call) {
    constexpr std::int64_t most = 500;
    return static_cast<std::size_t>(call.whole_number("limit", 100, 1, most));
}

std::pair<std::string, std::string> place_of(const std::string& cursor) {
    const std::size_t split = cursor.find('~');
    if (split == std::string::npos)
        throw bad_request("cursor must be the \"next\" of an earlier page");
    return {cursor.substr(0, split), cursor.substr(split + 1)};
}

std::string accept_study(Service& service, Call& call, Ask ask) {
    const std::string& body = call.json_body();
    const auto key = idempotency_key(call.request);
    if (!key) return stored(service, call, body, ask, [](Transaction&, const std::string&) {});
    // Before the store is asked: of two equal requests only one gets past this line.
    const KeyInProgress seat(service.keys, *key, call.response);
    const std::string hash = exchange::sha256_of_text(body);
    if (const auto known = service.store.run_of_key(*key)) {
        // The key stands for one request; with another body it is a mistake of the client.
        if (known->body_sha256 != hash)
            throw Problem{422, "/problems/idempotency-key-reused", "Idempotency-Key reused",
                          "this key was sent before with another body; use a new key"};
        call.response.set_header("Idempotent-Replayed", "true");
        return known->run;
    }
    return stored(service, call, body, ask, [&](Transaction& transaction, const std::string& run) {
        transaction.keep_idempotency_key(*key, hash, run);
    });
}

}  // namespace breach::orchestrator
