// Files that studies name: motions and meshes. An upload is written to a file of its own and
// hashed; only then the store publishes it under its hash, in the transaction of its row. With a
// hash in the request, an interrupted upload is kept and resumed.
#include <algorithm>
#include <array>

#include "core/check/mesh_file.hpp"
#include "core/exchange/provenance.hpp"
#include "core/motion/plausibility.hpp"
#include "core/motion/read_motion.hpp"
#include "core/scene/file_paths.hpp"
#include "services/orchestrator/files/arriving_file.hpp"
#include "services/orchestrator/files/failpoint.hpp"
#include "services/orchestrator/files/sync_folder.hpp"
#include "services/orchestrator/http/answers.hpp"
#include "services/orchestrator/http/http_routes.hpp"
#include "services/orchestrator/records/identity.hpp"

namespace breach::orchestrator {

namespace fs = std::filesystem;
using nlohmann::json;

namespace {

/// Known file types; any other file is read as two columns of text.
constexpr std::array<std::string_view, 5> endings{".at2", ".vt2", ".dt2", ".csv", ".msh"};
constexpr const char* other_ending = ".txt";

/// The ending decides how a phase reads the file. It is kept because the name itself becomes the
/// hash.
std::string ending_of(const std::string& name) {
    std::string ending = fs::path(name).extension();
    std::ranges::transform(ending, ending.begin(), [](unsigned char c) { return std::tolower(c); });
    return std::ranges::find(endings, ending) != endings.end() ? ending : other_ending;
}

/// The sender's name of the file, for display only, never a path.
std::string sent_name(const Call& call) {
    constexpr std::size_t longest = 200;
    std::string name = fs::path(call.parameter("name").value_or("")).filename();
    const bool plain = std::ranges::none_of(
        name, [](unsigned char c) { return c < ' ' || c == 0x7f || c == '"' || c == '\\'; });
    if (name.empty() || name.size() > longest || !plain)
        throw bad_request(
            "name must be the file's name: the ending .msh says that it is a mesh, anything else "
            "is "
            "a motion");
    return name;
}

Problem disk_refused(const std::string& why) {
    return {503, "/problems/storage", "The disk refused", "nothing was stored: " + why};
}

/// Appends the body to the file. `kept`: an interrupted upload may be resumed.
/// Called by httplib's thread of this request, part by part. A fault of the disk is kept until the
/// sender is done, so that the answer can be read.
void take(const Call& call, ArrivingFile& file, std::size_t most, bool kept) {
    // Beyond this the connection is closed: a sender that ignores the limit must not occupy a
    // thread.
    constexpr std::size_t dropped = std::size_t{64} << 20;
    auto bytes = static_cast<std::size_t>(file.bytes());
    std::optional<std::string> refused;
    const bool whole = (*call.body)([&](const char* data, std::size_t size) {
        bytes += size;
        try {
            if (bytes <= most && !refused) file.append(data, size);
        } catch (const fault::IoError& error) {
            refused = error.what();
        }
        return bytes <= most + dropped;  // read on, so that the sender gets the answer
    });
    if (bytes > most)
        throw Problem{413, "/problems/too-large", "Content too large",
                      "a file may have " + std::to_string(most) + " bytes (--largest-file)"};
    if (refused) throw disk_refused(*refused);
    if (whole) return;
    if (kept) file.keep_until_resumed();
    throw bad_request(kept ? "the file did not arrive whole; go on with from=" +
                                 std::to_string(file.bytes())
                           : "the file did not arrive whole; send it again");
}

/// sha256: announced by the sender; empty: not announced.
/// from = 0 begins again, what has arrived or not. Any other `from` must fit, or bytes would be
/// missing inside.
ArrivingFile arriving_file(const Service& service, const std::string& sha256,
                           const std::string& ending, std::int64_t from) {
    if (sha256.empty()) {
        if (from > 0) throw bad_request("from needs sha256, the file that this is the rest of");
        return ArrivingFile::of_one_request(service.data.scratch() / (new_run_id() + ending));
    }
    if (!exchange::is_sha256(sha256)) throw bad_request("sha256 must be 64 hex digits");
    auto file = ArrivingFile::resumable(service.data.arriving(), sha256 + ending);
    if (!file)
        throw Problem{409, "/problems/being-sent", "Being sent",
                      "another client is sending this file; ask again how much has arrived"};
    if (from == 0) file->begin_anew();
    if (file->bytes() == from) return std::move(*file);
    if (file->bytes() > 0) file->keep_until_resumed();
    throw Problem{
        409, "/problems/other-part", "Another part",
        std::to_string(file->bytes()) + " bytes of it have arrived, so from must be that, or 0"};
}

/// Identifies the file with the reader for its type, and returns the reader's warnings. Throws
/// BadInput with the sender's name of the file.
/// A file that no phase could read is refused now, not when its FEM starts.
std::vector<fault::Flag> recognise(const fs::path& path, StoredFile& file) {
    try {
        if (path.extension() == ".msh") {
            const check::MeshHead head = check::read_mesh_head(path);
            file.kind = "mesh";
            file.about = "gmsh " + head.version + ", " + std::to_string(head.surfaces.size()) +
                         " physical surfaces";
            return {};
        }
        const motion::Recording motion = motion::read_motion(path);
        file.kind = "motion";
        file.about = motion::summary_of(motion);
        return motion::warnings_about(motion, "");
    } catch (const fault::BadInput& error) {
        std::vector<fault::Fault> faults = error.faults();
        for (fault::Fault& each : faults)
            each.remedy += (each.remedy.empty() ? "" : "; ") +
                           std::string(
                               "send a motion (.AT2, .VT2, .csv or two columns) or a mesh "
                               "(.msh): nothing else is read");
        throw fault::BadInput("file " + file.name, std::move(faults));
    }
}

/// Warnings of a stored motion, which the present reader may refuse.
/// A file that was stored stays usable: faults become warnings.
std::vector<fault::Flag> warnings_again(const fs::path& path) {
    try {
        return motion::warnings_about(motion::read_motion(path), "");
    } catch (const fault::BadInput& error) {
        return {{"impossible", fault::Severity::questionable, error.what()}};
    }
}

json as_json(const StoredFile& file) {
    return {{"sha256", file.sha256},   {"reference", scene::reference_to(file.file)},
            {"name", file.name},       {"kind", file.kind},
            {"about", file.about},     {"bytes", file.bytes},
            {"created", file.created}, {"used", file.used}};
}

/// By size only: a hash of each motion at each request would take long. The audit compares
/// contents.
bool is_whole(const Service& service, const StoredFile& file) {
    std::error_code error;
    const auto size = fs::file_size(service.data.files() / file.file, error);
    return !error && static_cast<std::int64_t>(size) == file.bytes;
}

/// The rename runs inside the transaction (Transaction::keep_file): a row is never committed before
/// its file is in place.
void keep(Service& service, const ArrivingFile& arriving, const StoredFile& file) {
    pass_failpoint("upload_before");
    service.store.write([&](Transaction& transaction) {
        transaction.keep_file(file, [&] {
            fs::rename(arriving.path(), service.data.files() / file.file);
            sync_folder(service.data.files());
            pass_failpoint("upload_after");
        });
    });
}

/// 201: stored; 200: it existed.
void upload(Service& service, Call& call) {
    call.allow_parameters({"name", "sha256", "from"});
    if (call.request.get_header_value("Content-Type") != "application/octet-stream")
        throw Problem{
            415, "/problems/unsupported-media-type", "Unsupported media type",
            "send the file itself with the header Content-Type: application/octet-stream"};
    StoredFile file{.sha256 = {}, .file = {}, .name = sent_name(call), .kind = {}, .about = {}};
    if (call.body == nullptr) throw bad_request("the body must be the file itself");
    const std::string announced = call.parameter("sha256").value_or("");
    ArrivingFile arriving = arriving_file(service, announced, ending_of(file.name),
                                          call.whole_number("from", 0, 0, std::int64_t{1} << 53));
    take(call, arriving, service.largest_file, !announced.empty());
    arriving.sync();
    file.bytes = arriving.bytes();
    // From the disk, not from the stream: it is the stored bytes that count.
    file.sha256 = exchange::sha256_of_file(arriving.path());
    if (!announced.empty() && announced != file.sha256)
        throw Problem{422, "/problems/hash-mismatch", "Another file",
                      "what arrived has the SHA-256 " + file.sha256 + "; send it again"};
    const auto known = service.store.file(file.sha256);
    file.file = known ? known->file : file.sha256 + ending_of(file.name);
    // A known file that has vanished or been cut is stored again.
    const bool is_here = known && is_whole(service, *known);
    std::vector<fault::Flag> warnings;
    if (!is_here)
        warnings = recognise(arriving.path(), file);
    else if (known->kind == "motion")
        warnings = warnings_again(arriving.path());
    keep(service, arriving, file);
    call.response.set_header("Location", "/v1/files/" + file.sha256);
    json answer = as_json(service.store.file(file.sha256).value());
    answer["warnings"] = fault::as_json(warnings);
    reply(call.response, answer, is_here ? 200 : 201);
}

/// With the runs that name each file, since only files without any can be removed.
void list_files(const Service& service, Call& call) {
    call.allow_parameters({});
    json files = json::array();
    for (const StoredFile& each : service.store.files()) {
        files.push_back(as_json(each));
        files.back()["runs"] = each.runs;
    }
    reply(call.response, {{"files", std::move(files)}});
}

/// A row whose file has been lost is "not found": the client then sends the file again.
StoredFile wanted_file(const Service& service, const std::string& sha256) {
    auto file = service.store.file(sha256);
    if (!file || !is_whole(service, *file)) throw not_found("file " + sha256);
    return std::move(*file);
}

/// HEAD tells whether the upload can be skipped, and postpones the file's removal; for an
/// incomplete upload it returns the number of bytes received.
void show_file(Service& service, Call& call) {
    call.allow_parameters({});
    if (const auto bytes = arrived_bytes(service.data.arriving(), call.parts[0]); bytes > 0)
        call.response.set_header("X-Arrived-Bytes", std::to_string(bytes));
    const StoredFile file = wanted_file(service, call.parts[0]);
    // A client asks before it submits: the file must not be removed as unused in between.
    if (call.request.method == "HEAD")
        service.store.write([&](Transaction& transaction) { transaction.touch_file(file.sha256); });
    call.response.set_header("X-File-Reference", scene::reference_to(file.file));
    send_content(call, service.data.files() / file.file, file.sha256, file.bytes, file.file);
}

void remove_file(Service& service, Call& call) {
    call.allow_parameters({});
    const std::string& sha256 = call.parts[0];
    const auto file = service.store.file(sha256);
    if (!file) throw not_found("file " + sha256);
    // Whether a run names the file is asked in the transaction that removes it.
    const Removal outcome = service.store.write([&](Transaction& transaction) {
        return transaction.forget_file(sha256,
                                       [&] { fs::remove(service.data.files() / file->file); });
    });
    if (outcome == Removal::needed)
        throw Problem{409, "/problems/needed", "Needed",
                      "runs name this file (GET /v1/files, or: breach files): remove them first"};
    if (outcome == Removal::unknown) throw not_found("file " + sha256);
    reply(call.response, {{"id", sha256}, {"freed_bytes", file->bytes}}, 202);
}

}  // namespace

/// For motions that the service makes itself (templates, imports).
std::string keep_motion(Service& service, const std::string& name, const std::string& text) {
    ArrivingFile arriving =
        ArrivingFile::of_one_request(service.data.scratch() / (new_run_id() + ending_of(name)));
    arriving.append(text.data(), text.size());
    arriving.sync();
    StoredFile file{.sha256 = exchange::sha256_of_file(arriving.path()),
                    .file = {},
                    .name = name,
                    .kind = {},
                    .about = {}};
    file.bytes = static_cast<std::int64_t>(text.size());
    file.file = file.sha256 + ending_of(name);
    recognise(arriving.path(), file);
    keep(service, arriving, file);
    return scene::reference_to(file.file);
}

json files_json(const Service& service, const std::string& run) {
    json files = json::array();
    for (const StoredFile& each : service.store.files_of(run)) files.push_back(as_json(each));
    return files;
}

void add_file_routes(Router& router, Service& service) {
    router.post("/v1/files", [&](Call& call) { upload(service, call); });
    router.get("/v1/files", [&](Call& call) { list_files(service, call); });
    router.get("/v1/files/{sha256}", [&](Call& call) { show_file(service, call); });
    router.remove("/v1/files/{sha256}", [&](Call& call) { remove_file(service, call); });
}

}  // namespace breach::orchestrator
