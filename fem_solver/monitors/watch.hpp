// Monitors liquefaction and failure surfaces of the body.
// Owned by Course. It keeps the body without columns, so that no caller has to cut arrays.
#pragma once

#include "fem_solver/monitors/failure_surface.hpp"
#include "fem_solver/monitors/liquefaction.hpp"
#include "fem_solver/monitors/monitors.hpp"
#include "fem_solver/solve/beginning.hpp"

namespace breach::fem {

/// Whether and where liquefaction is monitored.
process::Decided<std::optional<scene::LiquefactionWatch>> liquefaction_watch(const scene::Fem& fem);

class Watch {
  public:
    Watch(const scene::Fem& fem, const Model& model);

    /// Changes to the present elements, for stages that change the body.
    void look_at(const Model& model);

    /// Excess pore pressure, r_u, depth of liquefaction, failure surfaces; zeros if dry and before
    /// the first dynamic stage.
    void read(const Model& model, const Motion& motion, const Beginning& beginning,
              Reading& reading) const;

    /// epsilon_q: [elements of the body].
    FailureSurfaces failure_surfaces(std::span<const double> epsilon_q) const;
    /// u - u_0 at the body's nodes, averaged over the same elements as in a snapshot [Pa].
    std::vector<double> excess_pressure(const Model& model, const Motion& motion,
                                        const Beginning& beginning) const;
    double failure_strain() const { return failure_strain_; }
    /// Includes absent elements.
    const Mesh& body() const { return body_; }

  private:
    void read_water(const Model& model, const Motion& motion, const Beginning& beginning,
                    Reading& reading) const;

    Mesh body_;     ///< without free-field columns
    Mesh present_;  ///< all nodes, present elements
    Ground ground_;
    LiquefactionWindow window_{};
    double least_stress_ = 0.0;
    std::vector<std::int32_t> nodes_;  ///< in the window; empty: no monitoring
    double failure_strain_;
    double failure_separation_;
};

}  // namespace breach::fem
