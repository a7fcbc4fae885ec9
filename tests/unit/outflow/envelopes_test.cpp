#include "services/outflow/envelopes.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <limits>
#include <nlohmann/json.hpp>

#include "core/fault/fault.hpp"
#include "tests/folder.hpp"

namespace breach::outflow {
namespace {

constexpr double never = std::numeric_limits<double>::quiet_NaN();

/// As deep as `depth` where it arrived, nothing elsewhere.
Envelope sample(std::vector<double> x, const std::vector<double>& arrival, double depth) {
    Envelope e{.x = std::move(x)};
    for_each_quantity(e, [&](auto, auto, auto& values) { values.assign(arrival.size(), 0.0); });
    e.arrival = e.time_of_peak = arrival;
    for (std::size_t k = 0; k < arrival.size(); ++k)
        if (!std::isnan(arrival[k])) e.largest_depth[k] = depth;
    return e;
}

const Band& band(const Ensemble& ensemble, const std::string& quantity) {
    for (const Band& each : ensemble.bands)
        if (each.quantity == quantity) return each;
    throw std::out_of_range(quantity);
}

// numpy.percentile([1, 2, 3, 4, 5], [10, 50, 90]) = [1.4, 3, 4.6]
TEST(Ensemble, PercentilesAreNumpysAndSayOnHowManyTheyRest) {
    std::vector<Envelope> samples;
    for (const double v : {3.0, 1.0, 5.0, 2.0, 4.0})
        samples.push_back(sample({0, 10, 20}, {v, v <= 3.0 ? v : never, never}, v));
    const Ensemble e = ensemble_of(samples);
    EXPECT_EQ(e.samples, 5U);
    EXPECT_EQ(e.reached, (std::vector<std::size_t>{5, 3, 0}));
    const Band& depth = band(e, "largest_depth");
    EXPECT_NEAR(depth.p10[0], 1.4, 1e-12);
    EXPECT_NEAR(depth.p50[0], 3.0, 1e-12);
    EXPECT_NEAR(depth.p90[0], 4.6, 1e-12);
    // At 10: depths 0, 0, 1, 2, 3; times 1, 2, 3, never, never.
    EXPECT_NEAR(depth.p50[1], 1.0, 1e-12);
    EXPECT_NEAR(depth.p90[1], 2.6, 1e-12);
    EXPECT_EQ(depth.rests_on[1], 5U);
    const Band& arrival = band(e, "arrival");
    EXPECT_NEAR(arrival.p10[1], 1.4, 1e-12);
    EXPECT_NEAR(arrival.p50[1], 3.0, 1e-12);
    EXPECT_TRUE(std::isnan(arrival.p90[1]));
    EXPECT_EQ(arrival.rests_on[1], 3U);
    EXPECT_TRUE(std::isnan(arrival.p10[2]));
    EXPECT_EQ(depth.p90[2], 0.0);
    const nlohmann::json json = as_json(e);
    EXPECT_TRUE(json.at("/bands/arrival/p90/1"_json_pointer).is_null());
    EXPECT_EQ(json.at("/bands/arrival/unit"_json_pointer), "s");
}

TEST(Ensemble, ReadsFinerGridsBetweenTheirColumnsAndNothingBeyondThem) {
    const std::vector<Envelope> samples{sample({0, 10, 20}, {1, 3, 9}, 2.0),
                                        sample({0, 4, 8, 12, 16}, {1, 2, 3, 4, never}, 6.0)};
    const Ensemble e = ensemble_of(samples);
    EXPECT_EQ(e.x, samples[0].x);
    const Band& arrival = band(e, "arrival");
    EXPECT_NEAR(arrival.p50[1], 3.25, 1e-12);  // of 3 and 3.5
    EXPECT_EQ(arrival.rests_on[2], 1U);
    EXPECT_EQ(e.reached[2], 1U);
    EXPECT_NEAR(band(e, "largest_depth").p50[1], 4.0, 1e-12);
    EXPECT_NEAR(band(e, "largest_depth").p50[2], 1.0, 1e-12);
}

TEST(Ensemble, OfNothingIsNothing) { EXPECT_EQ(as_json(ensemble_of({})).at("samples"), 0); }

TEST(Envelopes, AreReadFromTheTableAndRefusedWhereItIsNone) {
    const breach::test::Folder folder;
    const auto write = [&](const std::string& text) {
        std::ofstream(folder / "envelope.csv") << text;
        return folder / "envelope.csv";
    };
    const std::string header =
        "x_m,largest_depth_m,largest_velocity_m_per_s,largest_momentum_flux_m3_per_s2,arrival_s,"
        "time_of_peak_s,final_depth_m\n";
    const Envelope e = read_envelope(write(header + "0,2,3,18,0.5,1,1.5\n1,0,0,0,,,0\n"));
    EXPECT_EQ(e.x, (std::vector<double>{0, 1}));
    EXPECT_EQ(e.largest_momentum_flux[0], 18.0);
    EXPECT_EQ(e.arrival[0], 0.5);
    EXPECT_TRUE(std::isnan(e.arrival[1]) && std::isnan(e.time_of_peak[1]));
    EXPECT_EQ(e.final_depth[0], 1.5);
    EXPECT_THROW(read_envelope(write("x,y\n1,2\n")), fault::BadInput);
    EXPECT_THROW(read_envelope(write(header)), fault::BadInput);
    EXPECT_THROW(read_envelope(write(header + "0,2,3\n1,2,3\n")), fault::BadInput);
    EXPECT_THROW(read_envelope(write(header + "1,2,3,18,0,1,1\n0,2,3,18,0,1,1\n")),
                 fault::BadInput);
    EXPECT_THROW(read_envelope(folder / "none.csv"), fault::IoError);
}

}  // namespace
}  // namespace breach::outflow
