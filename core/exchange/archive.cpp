// Checkpoints, histories and the service's results table in one layout: three groups, one for each
// type of value, with one dataset per name. The phase that writes a kind decides what its names
// mean.
#include "core/exchange/archive.hpp"

#include <utility>

#include "core/exchange/common_groups.hpp"
#include "core/exchange/hdf5_file.hpp"

namespace breach::exchange {
namespace {

const std::string reals = "/breachline/reals";
const std::string integers = "/breachline/integers";
const std::string texts = "/breachline/texts";

}  // namespace

void write_archive(const std::filesystem::path& path, const Archive& archive,
                   const Provenance& provenance) {
    Hdf5Image image({archive.kind, archive.version});
    for (const std::string& group : {reals, integers, texts}) image.group(group);
    for (const auto& [name, values] : archive.reals) {
        const auto unit = archive.units.find(name);
        image.array(reals + "/" + name, values, 0, unit == archive.units.end() ? "" : unit->second);
    }
    for (const auto& [name, values] : archive.integers)
        image.array(integers + "/" + name, std::span<const std::int64_t>(values));
    for (const auto& [name, text] : archive.texts) image.strings(texts + "/" + name, {text});
    write_provenance(image, provenance);
    std::move(image).save(path);
}

/// Versions are not converted: the remedy of the fault is to start afresh.
Archive read_archive(const std::filesystem::path& path, const std::string& kind, int version,
                     Reals may_be) {
    Hdf5Reader reader(path, {{kind, version}}, "remove the file and start afresh");
    Archive archive{
        .kind = kind, .version = version, .reals = {}, .integers = {}, .texts = {}, .units = {}};
    for (const std::string& name : reader.names_in(reals)) {
        const std::string dataset = reals + "/" + name;
        archive.reals[name] =
            may_be == Reals::finite ? reader.finite_reals(dataset) : reader.any_reals(dataset);
        if (reader.has_attribute(dataset, "unit"))
            archive.units[name] = reader.text_attribute(dataset, "unit");
    }
    for (const std::string& name : reader.names_in(integers))
        archive.integers[name] = reader.any_integers(integers + "/" + name);
    for (const std::string& name : reader.names_in(texts))
        // A text is written as one row; a row is read as far as its first zero byte.
        for (const std::string& text : reader.strings(texts + "/" + name))
            archive.texts[name] += text;
    archive.spent = read_provenance(reader).spent;
    reader.refuse_if_faulty();
    return archive;
}

}  // namespace breach::exchange
