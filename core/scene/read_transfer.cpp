// What transfer_tool does with the scene: /transfer.
#include "core/scene/reader.hpp"

namespace breach::scene {

using nlohmann::json;

void read_transfer(Reader& reader, Scene& scene) {
    if (!reader.sound("/transfer")) return;
    const json& transfer = reader.document().at("transfer");
    scene.transfer = Transfer{
        .points_per_direction = transfer.at("points_per_direction"),
        .interpolation =
            transfer.at("interpolation") == "local" ? Interpolation::local : Interpolation::paper,
        .neighbours = transfer.at("neighbours"),
        .softening_start = transfer.at("softening_start") == "carried" ? SofteningStart::carried
                                                                       : SofteningStart::zero,
        .largest_mass_loss = transfer.at("largest_mass_loss"),
        .largest_momentum_loss = transfer.at("largest_momentum_loss"),
    };
}

}  // namespace breach::scene
