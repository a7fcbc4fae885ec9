#include "mpm_solver/step.hpp"
#include "mpm_solver/viscosity.hpp"

namespace breach::mpm {

namespace {

/// What one point gives to its nodes. With N_i = N_x N_y, the momentum m N_i (v + L (x_i - x_p))
/// and the force -V sigma grad N_i are both of the form N_x-part times N_y-part, so a node costs
/// two products of four numbers:
///   (P_i) (N_j, N_j, N_j, N_j) + (Q_i) (N_j dy_j, N_j dy_j, dN_j, dN_j)
struct Given {
    double m, mvx, mvy;
    double mLxx, mLxy, mLyx, mLyy;
    double fxx, fyy, fxy;  ///< -V sigma / h [N]
};

Given given(const Points& points, std::size_t p, const Grid& grid, const InPlane& sigma) {
    const double h = grid.h;
    const double m = points.m[p];
    const double share = -points.V[p] * grid.per_h;
    return {.m = m,
            .mvx = m * points.vx[p],
            .mvy = m * points.vy[p],
            .mLxx = m * h * points.Lxx[p],
            .mLxy = m * h * points.Lxy[p],
            .mLyx = m * h * points.Lyx[p],
            .mLyy = m * h * points.Lyy[p],
            .fxx = share * sigma.xx,
            .fyy = share * sigma.yy,
            .fxy = share * sigma.xy};
}

void scatter(Grid& grid, const Stencil& sx, const Stencil& sy, const Given& g) {
    Lane N[3];
    Lane M[3];
    for (int j = 0; j < 3; ++j) {
        const double Ny = sy.N[j];
        const double moment = Ny * (sy.first + j - sy.centre);
        N[j] << Ny, Ny, Ny, Ny;
        M[j] << moment, moment, sy.dN[j], sy.dN[j];
    }
    for (int i = 0; i < 3; ++i) {
        const double Nx = sx.N[i];
        const double dNx = sx.dN[i];
        const double dx = sx.first + i - sx.centre;
        const Lane P{Nx * (g.mvx + g.mLxx * dx), Nx * (g.mvy + g.mLyx * dx), dNx * g.fxx,
                     dNx * g.fxy};
        const Lane Q{Nx * g.mLxy, Nx * g.mLyy, Nx * g.fxy, Nx * g.fyy};
        const std::int32_t column = (sx.first + i) * grid.rows + sy.first;
        Lane* motion = &grid.motion[column];
        double* mass = &grid.mass[column];
        for (int j = 0; j < 3; ++j) {
            motion[j] += P * N[j] + Q * M[j];
            mass[j] += g.m * Nx * sy.N[j];
        }
    }
}

/// stress(p) is the stress that the force of point p comes from.
template <class Kernel, class Stress>
void scatter_zone(Body& body, const Zone& zone, const Stress& stress) {
    Grid& grid = body.grid;
    const Points& points = body.points;
    const Kernel kernel = kernel_of<Kernel>(body);
    for (std::size_t p = zone.begin; p < zone.end; ++p) {
        const Stencil sx = kernel(grid.xi(points.x[p]), grid.walls_x);
        const Stencil sy = kernel(grid.eta(points.y[p]), grid.walls_y);
        grid.use_stencil(sx.first * grid.rows + sy.first);
        scatter(grid, sx, sy, given(points, p, grid, stress(p)));
    }
}

}  // namespace

template <class Kernel>
void particle_to_grid(Body& body) {
    const Points& points = body.points;
    for (const Zone& zone : body.zones) {
        const auto of_the_law = [&points](std::size_t p) -> InPlane {
            return {points.sxx[p], points.syy[p], points.sxy[p]};
        };
        const auto with_viscosity = [&, eta = zone.viscosity](std::size_t p) -> InPlane {
            const InPlane tau = viscous_stress(points, p, eta);
            return {points.sxx[p] + tau.xx, points.syy[p] + tau.yy, points.sxy[p] + tau.xy};
        };
        if (zone.viscosity > 0.0) {
            scatter_zone<Kernel>(body, zone, with_viscosity);
        } else {
            scatter_zone<Kernel>(body, zone, of_the_law);
        }
    }
    find_active_nodes(body.grid);
}

template void particle_to_grid<GimpKernel>(Body&);
template void particle_to_grid<BSplineKernel>(Body&);
template void particle_to_grid<LinearKernel>(Body&);

}  // namespace breach::mpm
