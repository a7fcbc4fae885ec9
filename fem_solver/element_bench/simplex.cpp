#include "fem_solver/element_bench/simplex.hpp"

#include <algorithm>
#include <cmath>

namespace breach::element_bench {

namespace {

using Point = std::vector<double>;

struct Vertex {
    Point x;
    double f;
};

/// a + t (b - a).
Point between(const Point& a, const Point& b, double t) {
    Point out(a.size());
    for (std::size_t i = 0; i < a.size(); ++i) out[i] = a[i] + t * (b[i] - a[i]);
    return out;
}

double farthest(const std::vector<Vertex>& simplex) {
    double distance = 0.0;
    for (const Vertex& vertex : simplex) {
        for (std::size_t i = 0; i < vertex.x.size(); ++i) {
            distance = std::max(distance, std::abs(vertex.x[i] - simplex[0].x[i]));
        }
    }
    return distance;
}

/// Middle of all vertices but the worst, which is the last.
Point middle(const std::vector<Vertex>& simplex) {
    Point out(simplex[0].x.size(), 0.0);
    const std::size_t n = simplex.size() - 1;
    for (std::size_t k = 0; k < n; ++k) {
        for (std::size_t i = 0; i < out.size(); ++i) {
            out[i] += simplex[k].x[i] / static_cast<double>(n);
        }
    }
    return out;
}

}  // namespace

std::vector<double> least_by_simplex(const std::function<double(const std::vector<double>&)>& f,
                                     const std::vector<double>& start,
                                     const SimplexSettings& settings) {
    int evaluations = 0;
    const auto vertex = [&](Point x) {
        ++evaluations;
        const double value = f(x);
        return Vertex{std::move(x), value};
    };
    std::vector<Vertex> simplex{vertex(start)};
    for (std::size_t i = 0; i < start.size(); ++i) {
        Point x = start;
        x[i] += settings.size;
        simplex.push_back(vertex(std::move(x)));
    }
    const auto sort = [&] {
        std::stable_sort(simplex.begin(), simplex.end(),
                         [](const Vertex& a, const Vertex& b) { return a.f < b.f; });
    };
    sort();
    while (evaluations < settings.most_evaluations && farthest(simplex) > settings.least_size) {
        const Point centre = middle(simplex);
        Vertex& worst = simplex.back();
        const Vertex reflected = vertex(between(centre, worst.x, -1.0));
        if (reflected.f < simplex[0].f) {
            const Vertex expanded = vertex(between(centre, worst.x, -2.0));
            worst = expanded.f < reflected.f ? expanded : reflected;
        } else if (reflected.f < simplex[simplex.size() - 2].f) {
            worst = reflected;
        } else {
            const bool outside = reflected.f < worst.f;
            const Vertex contracted = vertex(between(centre, worst.x, outside ? -0.5 : 0.5));
            if (contracted.f < std::min(reflected.f, worst.f)) {
                worst = contracted;
            } else {
                for (std::size_t k = 1; k < simplex.size(); ++k) {
                    simplex[k] = vertex(between(simplex[0].x, simplex[k].x, 0.5));
                }
            }
        }
        sort();
    }
    return simplex[0].x;
}

}  // namespace breach::element_bench
