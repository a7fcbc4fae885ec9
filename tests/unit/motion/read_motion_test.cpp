// Motion files: each format, and faults that name their line.
#include "core/motion/read_motion.hpp"

#include <gtest/gtest.h>

#include <sstream>

#include "core/fault/fault.hpp"

namespace breach::motion {
namespace {

template <class Read>
std::string fault_of(Read read, const std::string& text) {
    std::istringstream in(text);
    try {
        read(in, "file");
    } catch (const fault::BadInput& bad) {
        return bad.faults().at(0).pointer + ": " + bad.faults().at(0).cause;
    }
    return "none";
}

const std::string header = "PEER\nA quake, somewhere\nACCELERATION TIME SERIES IN UNITS OF G\n";

TEST(Peer, ReadsBothOrdersOfTheSizeLineAndWindowsLineEnds) {
    for (const std::string size :
         {"NPTS=   3, DT=   .0050 SEC,  \r\n", "3    0.0050    NPTS, DT\n"}) {
        std::istringstream in(header + size + "  -.1000000E+00  .2E0\n +.05\r\r\n");
        const Recording r = read_peer(in, "file");
        EXPECT_EQ(r.title, "A quake, somewhere");
        EXPECT_EQ(r.quantity, Quantity::acceleration);
        EXPECT_DOUBLE_EQ(r.series.dt, 0.005);
        ASSERT_EQ(r.series.values.size(), 3u);
        EXPECT_DOUBLE_EQ(r.series.values[1], 0.2 * standard_gravity);
        EXPECT_DOUBLE_EQ(r.series.values[2], 0.05 * standard_gravity);
    }
}

TEST(Peer, NamesTheLineOfAFault) {
    const std::string size = "NPTS= 3, DT= .01 SEC\n";
    EXPECT_EQ(fault_of(read_peer, header + size + "0.1 0.2\n0.3x\n"),
              "line 6: '0.3x' is not a finite number");
    EXPECT_EQ(fault_of(read_peer, header + size + "0.1 nan\n"),
              "line 5: 'nan' is not a finite number");
    EXPECT_EQ(fault_of(read_peer, header + size + "0.1 0.2\n"),
              "line 5: the file ends after 2 of 3 values");
    EXPECT_EQ(fault_of(read_peer, header + "NPTS= 3\n"), "line 4: does not give NPTS and DT");
    EXPECT_EQ(fault_of(read_peer, "a\nb\nc\n"), "line 3: names no known unit");
    EXPECT_EQ(fault_of(read_peer, "a\n"), "line 1: the header of four lines is incomplete");
}

TEST(TwoColumns, AreTimeAndAccelerationInG) {
    std::istringstream in("# made up\n0.00\t0.1\n0.01\t-0.2\n\n0.02 0.3\n");
    const Recording r = read_two_columns(in, "file");
    EXPECT_DOUBLE_EQ(r.series.dt, 0.01);
    EXPECT_DOUBLE_EQ(r.series.values[1], -0.2 * standard_gravity);
    EXPECT_EQ(fault_of(read_two_columns, "0 1\n0.01 2\n0.03 3\n"),
              "line 2: the times are not equally spaced");
    EXPECT_EQ(fault_of(read_two_columns, "0 1\n0.01 2 5\n"), "line 2: has 3 columns, not two");
    EXPECT_EQ(fault_of(read_two_columns, "0.01 1\n0.02 1\n"), "line 1: the first time is not zero");
}

TEST(Csv, CarriesItsUnitInTheHeader) {
    const std::string rows = "0,1\n0.5,2\n";
    const auto second = [&](const std::string& head) {
        std::istringstream in(head + "\n" + rows);
        return read_csv(in, "file").series.values.at(1);
    };
    EXPECT_DOUBLE_EQ(second("time_s,acceleration_g"), 2 * standard_gravity);
    EXPECT_DOUBLE_EQ(second("time_s,acceleration_m_s2"), 2.0);
    EXPECT_DOUBLE_EQ(second("time_s,velocity_cm_s"), 0.02);
    EXPECT_EQ(fault_of(read_csv, "t,a\n" + rows), "line 1: is no known header");
    EXPECT_EQ(fault_of(read_csv, ""), "line 0: holds no header");
}

TEST(Csv, IsReadAsItWasWritten) {
    const Series a{0.005, {0.0, 1.25, -3.5, 0.001}};
    std::stringstream file;
    write_csv(file, {Quantity::acceleration, a, ""}, "made up\ntwo lines");
    const Series b = read_csv(file, "file").series;
    EXPECT_DOUBLE_EQ(b.dt, a.dt);
    for (std::size_t i = 0; i < 4; ++i) EXPECT_NEAR(a.values[i], b.values[i], 1e-7);
    std::stringstream velocity;
    write_csv(velocity, {Quantity::velocity, a, ""}, "");
    const Recording v = read_csv(velocity, "file");
    EXPECT_EQ(v.quantity, Quantity::velocity);
    for (std::size_t i = 0; i < 4; ++i) EXPECT_NEAR(a.values[i], v.series.values[i], 1e-8);
    EXPECT_THROW(write_csv(file, {Quantity::displacement, a, ""}, ""), std::invalid_argument);
}

TEST(Csv, OfManyShortStepsIsReadAsItWasWritten) {
    for (const double dt : {0.0025, 0.0078125, 1.0 / 256.0}) {
        std::stringstream file;
        const auto samples = static_cast<std::size_t>(120.0 / dt);
        write_csv(file, {Quantity::acceleration, {dt, std::vector<double>(samples, 1.0)}, ""}, "");
        EXPECT_NEAR(read_csv(file, "file").series.dt, dt, 1e-9 * dt);
    }
}

TEST(Motion, ThatIsMissingIsAnIoError) {
    EXPECT_THROW(read_motion("/nowhere/quake.AT2"), fault::IoError);
}

TEST(Motion, ThatIsADeviceIsNotReadWithoutEnd) {
    EXPECT_THROW(read_motion("/dev/zero"), fault::IoError);
}

TEST(Motion, ThatIsTooLargeForItsUnitIsRefused) {
    EXPECT_EQ(fault_of(read_two_columns, "0 1e308\n0.01 2\n"),
              "line 1: '1e308' is not a finite number");
}

}  // namespace
}  // namespace breach::motion
