// Motion files: each format, and faults that name their line.
#include "core/motion/read_motion.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <utility>

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
    EXPECT_EQ(fault_of(read_peer, header + size + "0.1 0.2\n0.3 0.4\n"),
              "line 6: the file holds 4 values, and its header gives NPTS= 3");
    EXPECT_EQ(fault_of(read_peer, header + "NPTS= 3\n"),
              "line 4: the header has no line that gives NPTS and DT");
    EXPECT_EQ(fault_of(read_peer, header + "NPTS= 1, DT= .01\n"),
              "line 4: NPTS must be a whole number above 1 and DT positive");
    EXPECT_EQ(fault_of(read_peer, header + "NPTS= 3, DT= 10 MSEC\n"), "line 4: gives DT in MSEC");
    EXPECT_EQ(fault_of(read_peer, "a\n"), "line 1: the header has no line that gives NPTS and DT");
}

TEST(Peer, ReadsNumbersAsFortranWritesThem) {
    const std::pair<const char*, std::vector<double>> rows[] = {
        {"7.0923734E-20-7.7943408E-05-1.66E-04", {7.0923734e-20, -7.7943408e-05, -1.66e-04}},
        {"0.012-0.034 0.5-1.", {0.012, -0.034, 0.5, -1.0}},
        {"0.5+0.25-.125", {0.5, 0.25, -0.125}},
        {"1.5D-02 -0.3d+00-2.5D-03", {1.5e-2, -0.3, -2.5e-3}},
        {"0.709-100 1.5", {0.709e-100, 1.5}},
        {"0.709-100-0.709-101", {0.709e-100, -0.709e-101}},
        {"1.5E+00-100.25", {1.5, -100.25}}};
    for (const auto& [row, wanted] : rows) {
        std::istringstream in(header + "NPTS= " + std::to_string(wanted.size()) +
                              ", DT= .01 SEC\n" + row + "\n");
        const Recording r = read_peer(in, "file");
        for (std::size_t i = 0; i < wanted.size(); ++i)
            EXPECT_DOUBLE_EQ(r.series.values[i], wanted[i] * standard_gravity) << row;
    }
    for (const char* word : {"0.5--0.25", "0.5-", "1.5-02x", "0.709+200", "***"})
        EXPECT_NE(fault_of(read_peer, header + "NPTS= 2, DT= .01 SEC\n" + word + "\n")
                      .find("is not a finite number"),
                  std::string::npos)
            << word;
}

TEST(Peer, GivesItsTimeStepInSecondsOnly) {
    for (const std::string size :
         {"NPTS= 2, DT= .01", "NPTS= 2, DT= .01 SEC", "NPTS=2,DT=.01SEC", "NPTS=2,DT=.01S",
          "NPTS= 2 POINTS, DT= 0.01 Sec.", "NPTS= 2, DT= .01 SEC, FILTER 5 HZ",
          "2 .01 NPTS, DT (SEC)", "2 .01 SEC NPTS, DT", "DT= 1E-2 SECONDS, NPTS= 2",
          "DT (s)= .01, NPTS= 2"}) {
        std::istringstream in(header + size + "\n0.1 0.2\n");
        EXPECT_DOUBLE_EQ(read_peer(in, "file").series.dt, 0.01) << size;
    }
    const std::pair<const char*, const char*> others[] = {{"NPTS= 2, DT= 100 HZ", "HZ"},
                                                          {"NPTS= 2, DT= 100Hz", "HZ"},
                                                          {"NPTS= 2, DT= 0.01 MIN", "MIN"},
                                                          {"NPTS= 2, DT= 10 MSEC", "MSEC"},
                                                          {"2 10 MS NPTS, DT", "MS"},
                                                          {"2 100 NPTS, DT (HZ)", "HZ"},
                                                          {"DT= 10MILLISEC NPTS= 2", "MILLISEC"}};
    for (const auto& [size, unit] : others)
        EXPECT_EQ(fault_of(read_peer, header + size + "\n0.1 0.2\n"),
                  std::string("line 4: gives DT in ") + unit);
}

TEST(TwoColumns, AreTimeAndAccelerationInG) {
    std::istringstream in("# made up\n0.00\t0.1\n0.01\t-0.2\n\n0.02 0.3\n");
    const Recording r = read_two_columns(in, "file");
    EXPECT_DOUBLE_EQ(r.series.dt, 0.01);
    EXPECT_DOUBLE_EQ(r.series.values[1], -0.2 * standard_gravity);
    EXPECT_EQ(
        fault_of(read_two_columns, "0 1\n0.01 2\n0.03 3\n"),
        "line 3: the times are not equally spaced: from 0.01 s to 0.03 s is a step of 0.02 s, "
        "and most steps are 0.01 s");
    EXPECT_EQ(fault_of(read_two_columns, "0 1\n0.01 2\n0.005 3\n0.02 4\n"),
              "line 3: the time goes from 0.01 s to 0.005 s");
    EXPECT_EQ(fault_of(read_two_columns, "0 1\n0.01 2 5\n"), "line 2: has 3 columns, not two");
    EXPECT_EQ(fault_of(read_two_columns, "0.01 1\n0.02 1\n"), "line 1: the first time is not zero");
}

TEST(TwoColumns, MayHaveExponentsOfFortran) {
    std::istringstream in("0.000D+00 1.0D-01\n1.000D-02 2.0D-01\n2.000D-02 -3.0D-01\n");
    const Recording r = read_two_columns(in, "file");
    EXPECT_DOUBLE_EQ(r.series.dt, 0.01);
    EXPECT_DOUBLE_EQ(r.series.values.back(), -0.3 * standard_gravity);
}

TEST(TwoColumns, HaveTheUnitThatACommentNames) {
    const std::string rows = "0 1\n0.01 2\n";
    const auto read = [&](const std::string& comment) {
        std::istringstream in(comment + "\n" + rows);
        const Recording r = read_two_columns(in, "file");
        return std::pair(0.5 * r.series.values.at(1), r.quantity);
    };
    const std::pair<const char*, double> accelerations[] = {
        {"# time [s] acceleration [m/s2]", 1.0},
        {"# time [s], acceleration [m/s²]", 1.0},
        {"# acceleration in cm/s2\n# dt 0.01", 0.01},
        {"# acceleration in cm/s2, g = 981 cm/s2", 0.01},
        {"# time_s,acceleration_m_s2", 1.0},
        {"# t [s]  a [m/s^2]", 1.0},
        {"# units: gal", 0.01},
        {"# Units: s, m/s2", 1.0},
        {"# acc. (cm/sec/sec), PGA in g", 0.01},
        {"# acceleration in 0.01 g", 0.0980665},
        {"# cm/s2", 0.01},
        {"# acceleration in m/s2 scaled to a PGA of 0.3 g", 1.0},
        {"time acceleration(m/s2)", 1.0},
        // no unit: g
        {"# made up", standard_gravity},
        {"# time [s] acceleration [g]", standard_gravity},
        {"# Units: sec, g", standard_gravity},
        {"# PGA 0.3 g, PGV 25.6 cm/s, Arias intensity 1.33 m/s", standard_gravity},
        {"# PGV in cm/s: 25; M 6.5 at 12 km, depth in m", standard_gravity},
        {"# acceleration in the direction of the valley", standard_gravity},
        {"# acceleration (corrected), Vs30 (m/s): 760", standard_gravity},
        {"# acceleration_x in g", standard_gravity},
        {"# record scaled to 0.3 g", standard_gravity},
        {"# t a", standard_gravity},
        {"# time (s); acceleration (g), g = 9.81 m/s2", standard_gravity},
    };
    for (const auto& [comment, factor] : accelerations) {
        SCOPED_TRACE(comment);
        const auto [value, quantity] = read(comment);
        EXPECT_DOUBLE_EQ(value, factor);
        EXPECT_EQ(quantity, Quantity::acceleration);
    }
    EXPECT_EQ(read("# time (s) velocity (cm/s)"), std::pair(0.01, Quantity::velocity));
    for (const char* comment :
         {"# acceleration in mg", "# acceleration [mg]", "# acceleration (counts)",
          "# units: counts", "# Units: SI", "# acceleration in % g", "# time [ms] acceleration [g]",
          "# time_ms,acceleration_g", "# acceleration_mg", "# acceleration in hundredths of g",
          "# acceleration in g scaled by 10", "# acceleration in cm/s",
          "# converted: cm/s2 and g, acceleration in g and m/s2"}) {
        EXPECT_EQ(fault_of(read_two_columns, "# a\n" + std::string(comment) + "\n" + rows),
                  "line 2: names no unit that is known: \"" + std::string(comment).substr(2) + '"');
    }
    EXPECT_EQ(fault_of(read_two_columns, "# acceleration in g\n# record in gal\n" + rows),
              "line 2: names another unit than a line before it: \"record in gal\"");
    EXPECT_EQ(fault_of(read_two_columns, "time acceleration\n" + rows),
              "line 1: is a header that names no known unit: \"time acceleration\"");
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
    EXPECT_DOUBLE_EQ(second("\"time_s\",\"acceleration_m_s2\""), 2.0);
    std::istringstream quoted("\"time_s\",\"acceleration_m_s2\"\n\"0\",\"1\"\n\"0.5\",\"2\"\n");
    EXPECT_DOUBLE_EQ(read_csv(quoted, "file").series.values.at(1), 2.0);
    EXPECT_EQ(fault_of(read_csv, "t,a\n" + rows), "line 1: is no known header: \"t,a\"");
    EXPECT_DOUBLE_EQ(second("\xEF\xBB\xBFtime_s,acceleration_gal"), 0.02);
    EXPECT_DOUBLE_EQ(second("Time (s);Acceleration (cm/s²)"), 0.02);
    EXPECT_EQ(fault_of(read_csv, "time_ms,acceleration_g\n" + rows),
              "line 1: is no known header: \"time_ms,acceleration_g\"");
    EXPECT_EQ(fault_of(read_csv, "time_s,velocity_g\n" + rows),
              "line 1: is no known header: \"time_s,velocity_g\"");
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

/// The header's unit in SI and its quantity; 0: refused, with the header in the message.
std::pair<double, Quantity> unit_of(const std::string& units) {
    std::istringstream in("PEER\nA quake\n" + units + "\nNPTS= 2, DT= .01 SEC\n 1.0 1.0\n");
    try {
        const Recording r = read_peer(in, "file");
        return {r.series.values[0], r.quantity};
    } catch (const fault::BadInput& bad) {
        EXPECT_EQ(bad.faults().at(0).cause, "names no known unit: \"" + units + '"');
        return {0.0, Quantity::acceleration};
    }
}

TEST(Unit, IsAWholeWordOfTheHeader) {
    const std::pair<const char*, double> accelerations[] = {
        {"ACCELERATION TIME SERIES IN UNITS OF G", 9.80665},
        {"ACCELERATION TIME HISTORY IN UNITS OF G. FILTER POINTS: HP=0.5 Hz LP=13.0 Hz", 9.80665},
        {"Acceleration in units of g, 5 % damping", 9.80665},
        {"ACCELERATION TIME SERIES IN UNITS OF GAL", 0.01},
        {"ACCELERATION TIME SERIES IN UNITS OF GALS", 0.01},
        {"ACCELERATION TIME SERIES IN UNITS OF G/10", 0.980665},
        {"ACCELERATION TIME SERIES IN UNITS OF G / 1000", 0.00980665},
        {"ACCELERATION TIME SERIES IN UNITS OF 0.01 G", 0.0980665},
        {"ACCELERATION TIME SERIES IN UNITS OF 1/100*G", 0.0980665},
        {"ACCELERATION TIME SERIES IN UNITS OF 1/100 G", 0.0980665},
        {"ACCELERATION TIME SERIES IN UNITS OF G X 10", 98.0665},
        {"ACCELERATION TIME HISTORY IN UNITS OF CM/S/S", 0.01},
        {"ACCELERATION TIME HISTORY IN UNITS OF CM/SEC2", 0.01},
        {"ACCELERATION TIME HISTORY IN UNITS OF CM/SEC**2", 0.01},
        {"ACCELERATION TIME HISTORY IN UNITS OF CM/S^2.", 0.01},
        {"ACCELERATION, UNITS: CM/SEC/SEC", 0.01},
        {"ACCELERATION (CM PER SECOND PER SECOND)", 0.01},
        {"ACCELERATION, VELOCITY AND DISPLACEMENT, CM/S/S", 0.01},
        {"ACCELERATION, VELOCITY TIME HISTORY IN UNITS OF CM/S/S", 0.01},
        {"ACCELERATION IN UNITS OF MM/S2", 0.001},
        {"ACCELERATION IN UNITS OF M/S2", 1.0},
        {"ACCELERATION IN UNITS OF METERS/SEC/SEC", 1.0},
        {"ACCELERATION IN UNITS OF IN/S2", 0.0254},
        {"ACCELERATION IN UNITS OF FT/SEC2", 0.3048},
        {"ACCELERATION AT 12 M DEPTH IN G", 9.80665},
        {"ACCELERATION IN UNITS OF G FILTER POINTS HP=0.5", 9.80665},
        {"COMMUNITY HALL, ACCELERATION IN UNITS OF GAL", 0.01},
        {"ACCELERATION TIME SERIES IN UNITS OF G (1 G = 980.665 CM/SEC/SEC)", 9.80665},
        {"Acceleration in units of g (g = 9.81 m/s^2). Filter points: 0.1 Hz", 9.80665},
        {"ACCELERATION IN UNITS OF G, 1G=981.0CM/S**2", 9.80665},
        {"ACCELERATION IN UNITS OF G (9.80665 M/SEC2)", 9.80665},
        {"ACCELERATION IN G (386.1 IN/S2 = 1 G)", 9.80665},
    };
    for (const auto& [text, factor] : accelerations) {
        const auto [value, quantity] = unit_of(text);
        EXPECT_DOUBLE_EQ(value, factor) << text;
        EXPECT_EQ(quantity, Quantity::acceleration) << text;
    }
    EXPECT_EQ(unit_of("VELOCITY TIME SERIES IN UNITS OF CM/S"),
              std::pair(0.01, Quantity::velocity));
    EXPECT_EQ(unit_of("DISPLACEMENT TIME SERIES IN UNITS OF CM"),
              std::pair(0.01, Quantity::displacement));
}

TEST(Unit, ThatIsNoneOfTheListIsRefused) {
    for (const char* text : {"ACCELERATION TIME SERIES IN UNITS OF MG",
                             "ACCELERATION TIME SERIES IN UNITS OF MILLI G",
                             "ACCELERATION TIME SERIES IN UNITS OF % G",
                             "ACCELERATION IN UNITS OF GRAINS",
                             "ACCELERATION IN UNITS OF G 1/10",
                             "ACCELERATION IN UNITS OF G (X 10)",
                             "ACCELERATION IN UNITS OF G/0",
                             "ACCELERATION IN UNITS OF G/TEN",
                             "ACCELERATION IN UNITS OF CM/S",
                             "ACCELERATION IN UNITS OF KM/S2",
                             "ACCELERATION IN UNITS OF CM/S3",
                             "VELOCITY IN UNITS OF G",
                             "ACCELERATION",
                             "ACCELERATION IN 0.1 G",
                             "ACCELERATION IN G AND CM/S2",
                             "ACCELERATION COUNTS",
                             "ACCELERATION IN G, VELOCITY IN CM/S",
                             "ACCELERATION IN UNITS OF G HUNDREDTHS",
                             "ACCELERATION IN UNITS OF G TENTHS",
                             "ACCELERATION IN UNITS OF G SCALED BY 10",
                             "ACCELERATION IN UNITS OF G, SCALED BY 10",
                             "ACCELERATION IN UNITS OF G MULTIPLIED BY 10",
                             "ACCELERATION IN UNITS OF G DOZENS",
                             "ACCELERATION IN HUNDREDTHS OF G",
                             "ACCELERATION IN UNITS OF G (1 G = 98.0665 CM/SEC/SEC)",
                             "ACCELERATION IN UNITS OF G (1 MG = 980.665 CM/SEC/SEC)",
                             "ACCELERATION IN TEN G"})
        EXPECT_EQ(unit_of(text).first, 0.0) << text;
}

TEST(Times, MayBeRoundedOrCutOffInTheirLastDigit) {
    for (const double dt : {1.0 / 128.0, 1.0 / 256.0, 1.0 / 60.0})
        for (const bool cut : {false, true}) {
            std::string text;
            for (int i = 0; i < 400; ++i) {
                const double ms = 1000.0 * dt * i;
                char row[64];
                std::snprintf(row, sizeof row, "%.3f 0.1\n",
                              0.001 * (cut ? std::floor(ms) : std::round(ms)));
                text += row;
            }
            std::istringstream in(text);
            EXPECT_NEAR(read_two_columns(in, "file").series.dt, dt, 1e-9) << dt << cut;
        }
}

TEST(Times, ThatLeaveOutASampleNameItsLine) {
    for (const char* format : {"%.2f 0.1\n", "%.3f 0.1\n", "%.6f 0.1\n"}) {
        std::string text;
        for (int i = 0; i < 400; ++i) {
            char row[64];
            std::snprintf(row, sizeof row, format, 0.01 * (i < 201 ? i : i + 1));
            text += row;
        }
        EXPECT_EQ(
            fault_of(read_two_columns, text),
            "line 202: the times are not equally spaced: from 2 s to 2.02 s is a step of 0.02 "
            "s, and most steps are 0.01 s");
    }
}

TEST(Numbers, MayHaveDecimalCommas) {
    const auto last = [](auto read, const std::string& text) {
        std::istringstream in(text);
        const Series series = read(in, "file").series;
        return std::pair(series.dt, series.values.back() / standard_gravity);
    };
    const std::pair wanted(0.01, 0.25);
    EXPECT_EQ(last(read_two_columns, "0,00 0,5\n0,01 0,25\n"), wanted);
    EXPECT_EQ(last(read_two_columns, "0,00;0,5\n0,01;0,25\n"), wanted);
    EXPECT_EQ(last(read_two_columns, "0.00, .5\n0.01, .25\n"), wanted);
    EXPECT_EQ(last(read_csv, "time_s;acceleration_g\n0;0,5\n0,01;0,25\n"), wanted);
    EXPECT_EQ(last(read_peer, header + "NPTS= 3, DT= .01 SEC\n 0,5 0,1\n 0,25\n"), wanted);
    EXPECT_EQ(last(read_peer, header + "NPTS= 3, DT= .01 SEC\n0.5,0.1,0.25\n"), wanted);
    EXPECT_EQ(last(read_peer, header + "NPTS= 3, DT= ,01 SEC\n ,5 ,1\n ,25\n"), wanted);
    EXPECT_EQ(last(read_peer, header + "NPTS=3,DT=0,01SEC\n ,5 ,1\n ,25\n"), wanted);
    EXPECT_EQ(fault_of(read_two_columns, "0,00,0,5\n0,01,0,25\n"),
              "line 1: has 4 columns, not two");
}

TEST(Motion, IsReadInTheFormThatItHasUnderAnyName) {
    const auto folder = std::filesystem::temp_directory_path() / "breach_renamed_motions";
    std::filesystem::create_directories(folder);
    const auto second = [&](const std::string& name, const std::string& text) {
        std::ofstream(folder / name) << text;
        return read_motion(folder / name).series.values.at(1);
    };
    const std::string peer = header + "NPTS= 2, DT= .01 SEC\n 0.5 0.25\n";
    for (const char* name : {"a.csv", "a.dat", "a", "a.AT2"})
        EXPECT_DOUBLE_EQ(second(name, peer), 0.25 * standard_gravity) << name;
    for (const char* name : {"b.txt", "b.AT2"})
        EXPECT_DOUBLE_EQ(second(name, "time_s,acceleration_m_s2\n0,0.5\n0.01,0.25\n"), 0.25);
    EXPECT_DOUBLE_EQ(second("c.dat", "0 0.5\n0.01 0.25\n"), 0.25 * standard_gravity);
    EXPECT_THROW(second("c.csv", "0,0.5\n0.01,0.25\n"), fault::BadInput);  // in which unit?
    EXPECT_THROW(second("c.AT2", "0 0.5\n0.01 0.25\n"), fault::BadInput);
    EXPECT_EQ(fault_of(read_csv, std::string("\xFF\xFEt\0i\0", 6)),
              "line 1: holds zero bytes: the file is UTF-16 text, or no text");
    std::filesystem::remove_all(folder);
}

TEST(Motion, OfAPublishersOtherFormIsRefusedByItsName) {
    const auto file = std::filesystem::temp_directory_path() / "breach_other_form.NS";
    const std::pair<const char*, const char*> forms[] = {
        {"Origin Time 2011/03/11 14:46:00\nSampling Freq(Hz) 100Hz\n0 119\n", "KiK-net"},
        {"Corrected acceleration   (Format v01.20 with 13 text lines)\nStation\n", "COSMOS"},
        {"CORRECTED ACCELEROGRAM DATA  PROCESSED: 01/01/01\nStation\n", "V2"},
        {"Corrected  accelerogram\nGNS Science\n", "V2"},
        {"UNCORRECTED ACCELEROGRAM DATA  PROCESSED: 01/01/01\nStation\n", "V1"},
        {"Station\n 400 POINTS OF ACCEL DATA EQUALLY SPACED AT .010 SEC, IN CM/SEC2.\n", "V2"},
        {"2 CORRECTED ACCELEROGRAM\n*\n", "SMC"},
        {"EVENT_NAME: X\nSAMPLING_INTERVAL_S: 0.010000\nUNITS: cm/s^2\n0.0\n", "ESM"}};
    for (const auto& [text, form] : forms) {
        std::ofstream(file) << text;
        try {
            read_motion(file);
            ADD_FAILURE() << form;
        } catch (const fault::BadInput& bad) {
            EXPECT_NE(bad.faults().at(0).cause.find(form), std::string::npos);
            EXPECT_NE(bad.faults().at(0).remedy.find("convert it"), std::string::npos);
        }
    }
    std::ofstream(file) << "Corrected accelerogram\n" + header + "NPTS= 2, DT= .01 SEC\n0.5 0.25\n";
    EXPECT_EQ(read_motion(file).series.values.size(), 2u);  // the words are a PEER title's
    std::filesystem::remove(file);
}

TEST(Unit, ThatIsRefusedHasTheRightFactorInItsRemedy) {
    const auto remedy = [](auto read, const std::string& text) {
        std::istringstream in(text);
        try {
            read(in, "file");
        } catch (const fault::BadInput& bad) {
            return bad.faults().at(0).remedy;
        }
        return std::string("none");
    };
    const auto peer = [&](const std::string& unit) {
        return remedy(read_peer, "PEER\nA quake\nACCELERATION IN UNITS OF " + unit +
                                     "\nNPTS= 2, DT= .01 SEC\n 1.0 1.0\n");
    };
    EXPECT_NE(peer("% G").find("UNITS OF 0.01*G;"), std::string::npos);
    EXPECT_NE(peer("MG").find("UNITS OF 0.001*G;"), std::string::npos);
    EXPECT_EQ(peer("0.001*G"), "none");
    EXPECT_EQ(remedy(read_two_columns, "# acceleration in 0.001*G\n0 1\n1 2\n"), "none");
    EXPECT_NE(peer("COUNTS").find("UNITS OF G;"), std::string::npos);
    EXPECT_NE(remedy(read_two_columns, "# acceleration in mg\n0 1\n").find("in 0.001*G,"),
              std::string::npos);
    EXPECT_NE(remedy(read_csv, "time_s,acceleration_mg\n0,1\n").find("times 0.001 are in g"),
              std::string::npos);
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
