// Triggers with a real service, a slow fake FEM and fake phases (the fake MPM's runout is 10 +
// t_T^2).
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <map>
#include <thread>

#include "tests/faults/service_under_test.hpp"

namespace breach::testing {
namespace {

using nlohmann::json;

/// The sandbox with the slow FEM.
struct Live {
    Live() {
        std::filesystem::remove(sandbox.bin() / "fem_solver");
        std::filesystem::create_symlink(std::filesystem::path(BREACH_BIN) / "fake_live_fem",
                                        sandbox.bin() / "fem_solver");
    }
    void close_gate() const { std::ofstream(sandbox.root() / "gate") << "closed"; }
    void open_gate() const { std::filesystem::remove(sandbox.root() / "gate"); }
    /// Exit code of the FEM after 1.35 s; 0: it completes.
    void set_exit_code(int code) const { std::ofstream(sandbox.root() / "exit_code") << code; }
    Sandbox sandbox;
};

json with_triggers(const json& triggers) {
    json made = study("mpm_steps=2", {1.0});
    made.erase("transfer_times");
    made["triggers"] = triggers;
    made["stability"] = false;
    return made;
}

json triggers_of(Service& service, const std::string& run) {
    return service.get("/v1/runs/" + run + "/triggers").body.at("triggers");
}

/// Waits until every trigger is in a final state and the run is over.
json settled(Service& service, const std::string& run, const char* state = "succeeded") {
    const json end = service.wait_for_end(run, 60);
    EXPECT_EQ(end.value("state", ""), state) << end.dump();
    return triggers_of(service, run);
}

int count_tasks(Service& service, const std::string& run, const std::string& phase) {
    int count = 0;
    const json body = service.get("/v1/runs/" + run).body;
    for (const json& each : body.at("tasks")) count += each.at("phase") == phase ? 1 : 0;
    return count;
}

TEST(Trigger, CriterionFiresWhileTheFemRunsOnASnapshotItWasAskedFor) {
    const Live live;
    Service service(live.sandbox);
    const std::string run = service.submit(with_triggers({{{"kind", "criterion"},
                                                           {"name", "flat"},
                                                           {"when", "jacobian_least_avg < 0.97"},
                                                           {"within_s", 2.0}}}));
    const json trigger = settled(service, run).at(0);
    ASSERT_EQ(trigger.at("state"), "fired") << trigger;
    ASSERT_EQ(trigger.at("firings").size(), 1u);
    const json& firing = trigger.at("firings")[0];
    EXPECT_NEAR(firing.at("wanted_time"), 0.65, 1e-9);
    EXPECT_EQ(firing.at("fem_step"), 13);
    EXPECT_NEAR(firing.at("crossed").at("jacobian_least_avg"), 0.9675, 1e-12);
    EXPECT_GE(firing.at("transfer_time"), 0.65 - 1e-9);
    EXPECT_LT(firing.at("transfer_time"), 2.75);  // a requested snapshot, not the last one
    EXPECT_EQ(firing.at("sha256").get<std::string>().size(), 64u);
    EXPECT_TRUE(firing.at("start_ms").is_number()) << firing;
    std::cout << "lag " << firing.at("lag_s") << " s simulated; snapshot after "
              << firing.at("snapshot_ms") << " ms, fired " << firing.at("fired_ms")
              << " ms, transfer started " << firing.at("start_ms") << " ms\n";
    const json rows = service.table(run);
    ASSERT_EQ(rows.size(), 1u);
    EXPECT_EQ(rows[0].at("trigger"), "flat");
    EXPECT_EQ(rows[0].at("transfer_time"), firing.at("transfer_time"));
    EXPECT_EQ(rows[0].at("state"), "succeeded");

    const json transfers = service.get("/v1/transfers?why=criterion").body.at("transfers");
    ASSERT_EQ(transfers.size(), 1u);
    EXPECT_EQ(transfers[0].at("trigger"), "flat");
    EXPECT_EQ(transfers[0].at("condition"), "jacobian_least_avg < 0.97");
    EXPECT_EQ(transfers[0].at("crossed"), firing.at("crossed"));
    EXPECT_EQ(transfers[0].at("wanted_time"), firing.at("wanted_time"));
    EXPECT_EQ(transfers[0].at("snapshot_ms"), firing.at("snapshot_ms"));
    EXPECT_TRUE(transfers[0].at("start_ms").is_number()) << transfers[0];
    EXPECT_EQ(transfers[0].at("runouts")[0].at("runout"), rows[0].at("runout"));
    EXPECT_TRUE(service.get("/v1/transfers?why=at_time").body.at("transfers").empty());
}

TEST(Trigger, CrossedAndUncrossedInsideTheHoldDoesNotFire) {
    const Live live;
    Service service(live.sandbox);
    const std::string run = service.submit(
        with_triggers({{{"kind", "criterion"}, {"when", "epsilon_q_max > 0.5"}, {"hold_s", 0.2}}}));
    const json trigger = settled(service, run, "partial").at(0);
    EXPECT_EQ(trigger.at("state"), "expired");
    const std::string reason = trigger.at("reason");
    EXPECT_EQ(reason,
              "the FEM ended at 2.8 s, and epsilon_q_max > 0.5 had not held for 0.2 s; at its "
              "end epsilon_q_max = 0");
    EXPECT_EQ(trigger.at("result"), json({{"was_met", false}}));
    EXPECT_TRUE(service.table(run).empty());
    const json missing =
        service.get("/v1/runs/" + run + "/results").body.at("without_transfer").at(0);
    EXPECT_EQ(missing.at("state"), "not_reached");
    EXPECT_EQ(missing.at("stood"), true);
    EXPECT_EQ(missing.at("reason"), "criterion_1: " + reason);
    EXPECT_EQ(service.get("/v1/runs/" + run).body.at("message"),
              "no transfer: criterion_1: " + reason);
    const std::string csv = service.get("/v1/runs/" + run + "/results?format=csv").text;
    EXPECT_EQ(std::ranges::count(csv, '\n'), 2) << "a line for it, without numbers: " << csv;
    EXPECT_NE(csv.find(",\"not_reached\","), std::string::npos) << csv;
    EXPECT_EQ(service.get("/v1/runs/" + run + "/results?format=csv&state=failed").text,
              csv.substr(0, csv.find('\n') + 1));
}

TEST(Trigger, AWindowThatIsNoneDoesNotFireAndSaysSo) {
    const Live live;
    Service service(live.sandbox);
    const auto window = [](const char* pick) {
        return json{{"kind", "window"},           {"name", pick},
                    {"lower", "time >= 1"},       {"upper", "jacobian_least_avg < 0.97"},
                    {"snapshot_interval_s", 0.1}, {"pick", pick}};
    };
    const std::string run =
        service.submit(with_triggers({window("first"), window("midpoint"), window("last_before")}));
    for (const json& each : settled(service, run, "partial")) {
        EXPECT_EQ(each.at("state"), "expired");
        EXPECT_TRUE(each.at("reason").get<std::string>().starts_with(
            "there is no window: jacobian_least_avg < 0.97 is true since 0.65 s, and time >= 1 "
            "only from 1 s on"))
            << each;
        EXPECT_EQ(each.at("result"), json({{"was_met", true}}));
    }
    const json answer = service.get("/v1/runs/" + run + "/results").body;
    ASSERT_EQ(answer.at("without_transfer").size(), 1u);
    EXPECT_EQ(answer.at("without_transfer")[0].at("stood"), false) << "it failed, and was not run";
}

TEST(Trigger, SamplesThatNothingWasTransferredOfHaveEndedAndAreCountedApart) {
    const Live live;
    Service service(live.sandbox);
    json wanted = with_triggers({{{"kind", "window"},
                                  {"name", "window"},
                                  {"lower", "time >= 100"},
                                  {"upper", "time >= 200"}}});
    wanted["uncertainty"] = {
        {"samples", 3},
        {"seed", 7},
        {"parameters",
         {{{"name", "a"},
           {"sets", {"/mpm/cfl"}},
           {"distribution", {{"type", "uniform"}, {"from", 0.3}, {"to", 0.5}}}}}},
        {"transfer", {{"trigger", "window"}}}};
    const std::string run = service.submit(wanted);
    settled(service, run, "partial");
    const json answer = service.get("/v1/runs/" + run + "/uncertainty").body;
    const json& samples = answer.at("samples");
    EXPECT_EQ(samples.at("no_transfer"), 3) << samples;
    EXPECT_EQ(samples.at("open"), 0);
    EXPECT_EQ(samples.at("failed"), 0);
    ASSERT_EQ(samples.at("left_out").size(), 3u);
    EXPECT_EQ(samples.at("left_out")[0].at("state"), "not_reached");
    EXPECT_NE(samples.at("left_out")[0].at("reason").get<std::string>().find("at its end time = "),
              std::string::npos);
    EXPECT_TRUE(answer.at("sentences")[0].get<std::string>().starts_with(
        "0 of 3 samples ended with a result; of 3 nothing was transferred."))
        << answer.at("sentences");
}

TEST(Trigger, SeveralOnOneStepShareOneTransfer) {
    const Live live;
    Service service(live.sandbox);
    const json criterion{
        {"kind", "criterion"}, {"when", "jacobian_least_avg < 0.97"}, {"snapshot_interval_s", 0.1}};
    const std::string run = service.submit(with_triggers({criterion, criterion, criterion}));
    for (const json& each : settled(service, run)) {
        ASSERT_EQ(each.at("firings").size(), 1u) << each;
        EXPECT_NEAR(each.at("firings")[0].at("transfer_time"), 0.7, 1e-9);
    }
    ASSERT_EQ(service.table(run).size(), 1u);
    EXPECT_EQ(service.table(run)[0].at("trigger"), "criterion_1 criterion_2 criterion_3");
}

TEST(Trigger, WindowPicksAmongRegularSnapshots) {
    const Live live;
    Service service(live.sandbox);
    const auto window = [](const char* pick) {
        return json{{"kind", "window"},           {"name", pick},
                    {"lower", "time >= 0.5"},     {"upper", "time >= 1.5"},
                    {"snapshot_interval_s", 0.1}, {"pick", pick}};
    };
    json open = window("midpoint");
    open["name"] = "open";
    open["upper"] = "time > 1000";  // never true: the FEM's end at 2.8 closes it
    const std::string run = service.submit(
        with_triggers({window("first"), window("midpoint"), window("last_before"), open}));
    const double expected[] = {0.5, 1.0, 1.4, 1.6};
    const json triggers = settled(service, run);
    for (std::size_t i = 0; i < 4; ++i) {
        ASSERT_EQ(triggers[i].at("firings").size(), 1u) << triggers[i];
        EXPECT_NEAR(triggers[i].at("firings")[0].at("transfer_time"), expected[i], 0.0501) << i;
    }
}

/// State of a trigger, without wall clock times.
json outcome_of(const json& trigger) {
    json outcome{{"state", trigger.at("state")}, {"reason", trigger.at("reason")}};
    for (const json& each : trigger.at("firings"))
        for (const char* key : {"transfer_time", "wanted_time", "fem_step", "crossed"})
            outcome["firings"][key].push_back(each.at(key));
    return outcome;
}

TEST(Trigger, AWindowWithAHoldIsTheSameLiveAndFromTheWholeTelemetry) {
    const Live live;
    Service service(live.sandbox);
    const char* distorted = "jacobian_least_avg < 0.97";  // from 0.65 s on
    const auto window = [](const char* pick, const char* lower, const char* upper, double hold) {
        return json{{"kind", "window"}, {"lower", lower}, {"upper", upper},
                    {"hold_s", hold},   {"pick", pick},   {"snapshot_interval_s", 0.1}};
    };
    const json triggers{window("first", "time > 0.87", distorted, 0.2),
                        window("first", "time > 0.47", distorted, 0.5),
                        window("midpoint", "time > 0.47", distorted, 0.5),
                        window("first", "time > 0.52", "time > 0.57", 0.2),
                        window("first", "time > 0.47", "epsilon_q_max > 0.5", 0.2)};
    const std::string run = service.submit(with_triggers(triggers));
    service.wait_for_end(run, 60);
    const json seen_live = triggers_of(service, run);
    ASSERT_EQ(seen_live.size(), 5u);
    EXPECT_TRUE(seen_live[0].at("reason").get<std::string>().starts_with(
        "there is no window: jacobian_least_avg < 0.97 is true since 0.65 s"))
        << seen_live[0];
    EXPECT_TRUE(
        seen_live[3].at("reason").get<std::string>().starts_with("no snapshot lies between 0.55"))
        << "0.6 s is the upper edge: " << seen_live[3];
    const std::map<std::size_t, double> expected{{1, 0.5}, {2, 0.6}, {4, 0.5}};
    for (const auto& [i, time] : expected) {
        ASSERT_EQ(seen_live[i].at("firings").size(), 1u) << seen_live[i];
        EXPECT_NEAR(seen_live[i].at("firings")[0].at("transfer_time"), time, 1e-6) << i;
    }
    EXPECT_NEAR(seen_live[2].at("firings")[0].at("wanted_time"), 0.575, 1e-6);

    for (const json& each : triggers) {
        const Answer answer = service.post("/v1/runs/" + run + "/triggers", each.dump());
        EXPECT_EQ(answer.status, 202) << answer.text;
    }
    ASSERT_TRUE(eventually([&] {
        return std::ranges::all_of(triggers_of(service, run), [](const json& each) {
            return each.at("state") == "fired" || each.at("state") == "expired";
        });
    }));
    const json replayed = triggers_of(service, run);
    ASSERT_EQ(replayed.size(), 10u);
    for (std::size_t i = 0; i < 5; ++i)
        EXPECT_EQ(outcome_of(replayed[5 + i]), outcome_of(seen_live[i])) << i;
}

TEST(Trigger, WhatAFemThatWasCutShortLeavesOpenExpiresAndIsDecidedByTheRetry) {
    const Live live;
    live.set_exit_code(74);
    Service service(live.sandbox);
    const auto window = [](const char* name, const char* upper) {
        return json{{"kind", "window"}, {"name", name},       {"lower", "time >= 0.5"},
                    {"upper", upper},   {"pick", "midpoint"}, {"snapshot_interval_s", 0.1}};
    };
    const std::string run = service.submit(
        with_triggers({window("open", "time > 1000"),
                       window("closed", "time >= 1.2"),
                       {{"kind", "bisect"}, {"share", 0.75}, {"tolerance_s", 0.1}, {"seeds", 3}}}));
    service.wait_for_end(run, 60);
    const json cut_short = triggers_of(service, run);
    for (const std::size_t i : {0u, 2u}) {
        EXPECT_EQ(cut_short[i].at("state"), "expired") << cut_short[i];
        EXPECT_TRUE(cut_short[i].at("reason").get<std::string>().starts_with(
            "the FEM did not come to its end"))
            << cut_short[i];
        EXPECT_TRUE(cut_short[i].at("firings").empty());
    }
    EXPECT_EQ(cut_short[1].at("state"), "fired") << "both edges were known: " << cut_short[1];

    live.set_exit_code(0);
    EXPECT_EQ(service.post("/v1/runs/" + run + "/retry", "").status, 202);
    const json triggers = settled(service, run);
    for (const json& each : triggers) EXPECT_EQ(each.at("state"), "fired") << each;
    ASSERT_EQ(triggers[0].at("firings").size(), 1u);
    EXPECT_NEAR(triggers[0].at("firings")[0].at("transfer_time"), 1.65, 0.0501);
    EXPECT_EQ(outcome_of(triggers[1]), outcome_of(cut_short[1]));
    EXPECT_EQ(triggers[2].at("result").at("uniform_runs"), 28) << "of 2.8 s, not of 1.3 s";
}

TEST(Trigger, ABreakdownClosesTheWindowAsTheFemsEndDoes) {
    const Live live;
    live.set_exit_code(70);
    Service service(live.sandbox);
    const std::string run = service.submit(with_triggers({{{"kind", "window"},
                                                           {"lower", "time >= 0.5"},
                                                           {"upper", "time > 1000"},
                                                           {"snapshot_interval_s", 0.1}}}));
    service.wait_for_end(run, 60);
    const json trigger = triggers_of(service, run).at(0);
    ASSERT_EQ(trigger.at("state"), "fired") << trigger;
    EXPECT_NEAR(trigger.at("firings")[0].at("transfer_time"), 0.9, 0.0501);
}

TEST(Trigger, ManualFiresNowAndIsRefusedAfterTheEnd) {
    const Live live;
    Service service(live.sandbox);
    json plain = study("mpm_steps=2", {0.5});
    plain["stability"] = false;
    const std::string run = service.submit(plain);
    ASSERT_TRUE(eventually([&] {
        const json body = service.get("/v1/runs/" + run + "/telemetry?phase=fem_solver").body;
        return body.is_object() && body.value("next", 0) > 15;
    }));
    const Answer accepted =
        service.post("/v1/runs/" + run + "/triggers", R"({"kind":"manual","within_s":2})");
    EXPECT_EQ(accepted.status, 202) << accepted.text;
    const json trigger = settled(service, run).at(0);
    ASSERT_EQ(trigger.at("state"), "fired") << trigger;
    const double time = trigger.at("firings")[0].at("transfer_time");
    EXPECT_GE(time, 0.7);
    EXPECT_LT(time, 2.75);
    EXPECT_EQ(service.table(run).size(), 2u);
    EXPECT_EQ(service.post("/v1/runs/" + run + "/triggers", R"({"kind":"manual"})").status, 409);
}

TEST(Trigger, AfterTheFemEndedIsServedFromWhatExistsOrExpires) {
    const Live live;
    Service service(live.sandbox);
    json plain = study("mpm_steps=2", {0.5, 0.65});
    plain["stability"] = false;
    const std::string run = service.submit(plain);
    service.wait_for_end(run);
    const auto post = [&](const char* name, const char* when) {
        const json body{{"kind", "criterion"}, {"name", name}, {"when", when}};
        EXPECT_EQ(service.post("/v1/runs/" + run + "/triggers", body.dump()).status, 202);
    };
    post("served", "jacobian_least_avg < 0.97");  // at 0.65, when there is a snapshot
    post("late", "time > 1");                     // the next snapshot is the end
    const json triggers = settled(service, run);
    EXPECT_EQ(triggers[0].at("state"), "fired") << triggers[0];
    EXPECT_EQ(triggers[1].at("state"), "expired") << triggers[1];
    EXPECT_NE(triggers[1].at("reason").get<std::string>().find("within_s"), std::string::npos);
    EXPECT_EQ(service.table(run).size(), 2u);  // includes the given transfer at 0.65
}

TEST(Trigger, BisectFindsTheEdgeWithFewerRunsThanSnapshots) {
    const Live live;
    Service service(live.sandbox);
    const std::string run = service.submit(with_triggers(
        {{{"kind", "bisect"}, {"share", 0.75}, {"tolerance_s", 0.05}, {"seeds", 3}}}));
    const json trigger = settled(service, run).at(0);
    ASSERT_EQ(trigger.at("state"), "fired") << trigger;
    const json& result = trigger.at("result");
    // 0.75 (10 + 2.8^2) = 13.38 is reached at 1.838 s.
    EXPECT_NEAR(result.at("lower").at("off"), 1.80, 1e-6);
    EXPECT_NEAR(result.at("lower").at("on"), 1.85, 1e-6);
    EXPECT_TRUE(result.at("upper").at("off").is_null());
    EXPECT_EQ(result.at("uniform_runs"), 56);
    EXPECT_LE(result.at("runs"), 9);
    EXPECT_EQ(service.table(run).size(), result.at("runs").get<std::size_t>());
}

/// The runout is 10 + t_T^2, by_cell moves it by 2 cm x shift: the shifts are 0, 0.4588 and 0.0176.
TEST(Trigger, BisectIsDecidedByTheMeanOfTheRepeatsAndReportsWhereTheirBandStraddlesTheLevel) {
    const Live live;
    Service service(live.sandbox);
    json study = with_triggers(
        {{{"kind", "bisect"}, {"share", 0.75}, {"tolerance_s", 0.05}, {"seeds", 3}},
         {{"kind", "bisect"}, {"share", 0.7464}, {"tolerance_s", 0.05}, {"seeds", 3}}});
    study["scene"]["title"] = study["scene"]["title"].get<std::string>() + " by_cell=1";
    study["scene"]["mpm"]["cell_size"] = 1;
    study["draws"] = 3;
    const std::string run = service.submit(study);
    const json triggers = settled(service, run);
    const json& result = triggers.at(0).at("result");
    EXPECT_EQ(result.at("draws"), 3);
    EXPECT_NEAR(result.at("largest_runout"), 11 + 2.8 * 2.8 + 0.02 * 0.158780, 1e-4);
    // 0.75 (11 + 2.8^2) = 14.13 is reached at 1.769 s; the band is 2.92 x 5.2 mm / sqrt(3) = 9 mm.
    EXPECT_NEAR(result.at("lower").at("off"), 1.75, 1e-6);
    EXPECT_NEAR(result.at("lower").at("on"), 1.80, 1e-6);
    EXPECT_TRUE(result.at("straddling").empty()) << "1.75 s is 6.5 cm below the level";
    EXPECT_TRUE(result.at("with_fewer_draws").empty());
    // 0.7464 (11 + 2.8^2) = 14.065 is 1 mm below the mean at 1.75 s.
    const json& close = triggers.at(1).at("result");
    EXPECT_NEAR(close.at("lower").at("on"), 1.75, 1e-6);
    ASSERT_EQ(close.at("straddling").size(), 1u) << close;
    EXPECT_NEAR(close.at("straddling")[0].at("transfer_time"), 1.75, 1e-6);
    EXPECT_NEAR(close.at("straddling")[0].at("half_width"), 2.92 * 0.005199 / std::sqrt(3.0), 1e-5);
}

TEST(Trigger, KilledBetweenCrossingAndFiringMakesExactlyOneTransfer) {
    const Live live;
    live.close_gate();
    std::string run;
    {
        Service first(live.sandbox);
        run = first.submit(with_triggers(
            {{{"kind", "criterion"}, {"when", "jacobian_least_avg < 0.97"}, {"within_s", 3.0}}}));
        ASSERT_TRUE(
            eventually([&] { return triggers_of(first, run)[0].at("state") == "holding"; }));
        EXPECT_TRUE(triggers_of(first, run)[0].at("firings").empty());
        first.kill_at_once();
    }
    live.open_gate();
    std::this_thread::sleep_for(std::chrono::milliseconds(100));  // before the snapshot is noticed
    for (int kills = 0; kills < 2; ++kills) {
        Service again(live.sandbox);
        std::this_thread::sleep_for(std::chrono::milliseconds(30));
        again.kill_at_once();
    }
    Service last(live.sandbox);
    const json trigger = settled(last, run).at(0);
    EXPECT_EQ(trigger.at("state"), "fired") << trigger;
    EXPECT_EQ(trigger.at("firings").size(), 1u);
    EXPECT_NEAR(trigger.at("firings")[0].at("wanted_time"), 0.65, 1e-9);
    EXPECT_EQ(count_tasks(last, run, "transfer_tool"), 1);
    EXPECT_EQ(count_tasks(last, run, "mpm_solver"), 1);
    for (const auto& [output, count] : live.sandbox.successes()) EXPECT_EQ(count, 1) << output;
    int firings = 0;
    const json events = last.get("/v1/events?after=0&wait=0").body.at("events");
    for (const json& each : events)
        firings += each.at("detail").value("event", "") == "firing" ? 1 : 0;
    EXPECT_EQ(firings, 1);
}

TEST(Trigger, CancelDisarms) {
    const Live live;
    Service service(live.sandbox);
    const std::string run =
        service.submit(with_triggers({{{"kind", "criterion"}, {"when", "time > 2.5"}}}));
    ASSERT_TRUE(eventually([&] { return !phases_alive(live.sandbox, "fem_solver").empty(); }));
    service.post("/v1/runs/" + run + "/cancel", "");
    EXPECT_EQ(service.wait_for_end(run).at("state"), "cancelled");
    EXPECT_EQ(triggers_of(service, run)[0].at("state"), "disarmed");
}

TEST(Trigger, RetryArmsAgainWhatTheCancellingDisarmedAndNotWhatFired) {
    const Live live;
    Service service(live.sandbox);
    // Not a test of the delay: a slow service notices 0.2 s only at 2 s.
    const auto once = [](const char* name, const char* when) {
        return json{{"kind", "criterion"}, {"name", name}, {"when", when}, {"within_s", 10.0}};
    };
    json wanted = with_triggers({once("early", "time > 0.2"), once("late", "time > 2")});
    wanted["transfer_times"] = {2.5};
    const std::string run = service.submit(wanted);
    ASSERT_TRUE(eventually([&] { return triggers_of(service, run)[0].at("state") == "fired"; }));
    service.post("/v1/runs/" + run + "/cancel", "");
    EXPECT_EQ(service.wait_for_end(run).at("state"), "cancelled");
    EXPECT_EQ(triggers_of(service, run)[1].at("state"), "disarmed");

    EXPECT_EQ(service.post("/v1/runs/" + run + "/retry", "").status, 202);
    const json triggers = settled(service, run);
    for (const json& each : triggers) {
        EXPECT_EQ(each.at("state"), "fired") << each;
        EXPECT_EQ(each.at("reason"), "") << each;
        EXPECT_EQ(each.at("firings").size(), 1u) << each;
    }
    EXPECT_EQ(count_tasks(service, run, "transfer_tool"), 3);  // two triggers and a given time
    EXPECT_EQ(count_tasks(service, run, "mpm_solver"), 3);
    EXPECT_EQ(service.table(run).size(), 3u);
    std::vector<std::string> armed_again;
    std::int64_t seen = 0;
    while (true) {
        const std::string page = "/v1/events?wait=0&after=" + std::to_string(seen);
        const json events = service.get(page).body.at("events");
        if (events.empty()) break;
        for (const json& each : events)
            if (each.at("detail").value("what", "") == "rearm")
                armed_again.push_back(each.at("detail").at("name"));
        seen = events.back().at("seq");
    }
    EXPECT_EQ(armed_again, std::vector<std::string>{"late"});
}

TEST(Trigger, MistakesAreNamedWithPointerAndColumn) {
    const Live live;
    Service service(live.sandbox);
    const auto faults = [&](const json& triggers) {
        const Answer answer = service.post("/v1/runs", with_triggers(triggers).dump());
        EXPECT_EQ(answer.status, 422) << answer.text;
        return answer.body.at("faults")[0];
    };
    const json typo = faults({{{"kind", "criterion"}, {"when", "jacobain < 1"}}});
    EXPECT_EQ(typo.at("pointer"), "/triggers/0/when");
    EXPECT_EQ(typo.at("cause"), "column 1: there is no telemetry field 'jacobain'");
    EXPECT_EQ(faults({{{"kind", "window"}, {"lower", "time > 1"}}}).at("pointer"),
              "/triggers/0/upper");
    EXPECT_EQ(faults({{{"kind", "manual"}, {"when", "time > 1"}}}).at("pointer"),
              "/triggers/0/when");
    EXPECT_EQ(faults(json::array()).at("pointer"), "/transfer_times");
}

/// The critical depth of the fake stability analysis is its variant's residual strength. While a
/// file `lem_fails` exists in the sandbox, it ends with 74.
void make_depths(const Live& live) {
    const auto program = live.sandbox.bin() / "lem_tool";
    std::filesystem::remove(program);
    std::ofstream(program) << R"sh(#!/bin/sh
depth=1
while [ $# -gt 0 ]; do
    case "$1" in
        --version) printf 'lem_tool 0\nnumerics 1\n'; exit 0 ;;
        --output) out=$2 ;;
        /lem/liquefaction/0/residual_strength_kPa=*) depth=${1#*=} ;;
    esac
    shift
done
[ -e "$(dirname "$0")/../lem_fails" ] && exit 74
mkdir -p "$out"
printf '{"phase":"lem_tool","safety":1.2,"critical_depth":%s}' "$depth" > "$out/result.json"
)sh";
    std::filesystem::permissions(program, std::filesystem::perms::owner_all);
}

json of_two_depths(const json& triggers) {
    json made = with_triggers(triggers);
    made["stability"] = true;
    made["scene"]["lem"]["pore_pressure_ratios"] =
        json::array({{{"region", "slope"}, {"r_u", 0.01}}});
    made["scene"]["lem"]["liquefaction"] =
        json::array({{{"region", "slope"}, {"residual_strength_kPa", 1}}});
    made["variants"] = {
        {{"name", "firm"}, {"overrides", json::array()}},
        {{"name", "deep"}, {"overrides", {"/lem/liquefaction/0/residual_strength_kPa=4"}}}};
    return made;
}

TEST(Trigger, TakesTheCriticalDepthOfItsOwnVariant) {
    const Live live;
    make_depths(live);
    Service service(live.sandbox);
    const std::string run =
        service.submit(of_two_depths({{{"kind", "criterion"},
                                       {"when", "crest_displacement >= critical_depth"},
                                       {"snapshot_interval_s", 0.1}}}));
    const json triggers = settled(service, run);
    ASSERT_EQ(triggers.size(), 2u) << "one for each FEM: " << triggers;
    for (const json& row : service.table(run))
        EXPECT_NEAR(row.at("transfer_time"), row.at("variant") == "firm" ? 1.0 : 2.0, 0.0501)
            << row;
    EXPECT_EQ(service.table(run).size(), 2u);
    const json end = service.get("/v1/runs/" + run).body;
    EXPECT_NE(task_labelled(end, "fem_firm").at("same_as").is_null(),
              task_labelled(end, "fem_deep").at("same_as").is_null())
        << "equal FEMs are computed once";
}

TEST(Trigger, TakesTheFactorOfItsSnapshotsWhenTheFemHasEnded) {
    const Live live;
    const auto program = live.sandbox.bin() / "lem_tool";
    std::filesystem::remove(program);
    std::ofstream(program) << R"sh(#!/bin/sh
while [ $# -gt 0 ]; do
    case "$1" in
        --version) printf 'lem_tool 0\nnumerics 1\n'; exit 0 ;;
        --output) out=$2 ;;
        --input) [ -e "$2" ] || exit 74 ;;
    esac
    shift
done
mkdir -p "$out"
rows='{"time":0.5,"factor_of_safety":1.4},{"time":1.0,"factor_of_safety":1.1},{"time":1.5,"factor_of_safety":0.9}'
printf '{"phase":"post_seismic","factor_of_safety":0.9,"after_shaking":[%s]}' "$rows" > "$out/result.json"
)sh";
    std::filesystem::permissions(program, std::filesystem::perms::owner_all);
    Service service(live.sandbox);
    json wanted = of_two_depths({{{"kind", "criterion"},
                                  {"when", "post_seismic_factor < 1"},
                                  {"snapshot_interval_s", 0.5}}});
    wanted["stability"] = false;
    wanted.erase("variants");
    const json refused = service.post("/v1/runs", wanted.dump()).body;
    EXPECT_EQ(refused.at("faults").at(0).at("pointer"), "/triggers/0/when") << refused;
    wanted["post_seismic"] = true;
    const std::string run = service.submit(wanted);
    const json trigger = settled(service, run).at(0);
    ASSERT_EQ(trigger.at("state"), "fired") << trigger;
    EXPECT_NEAR(trigger.at("firings")[0].at("transfer_time"), 1.5, 1e-6);
    EXPECT_EQ(trigger.at("firings")[0].at("crossed").at("post_seismic_factor"), 0.9);
    const json rows = service.table(run);
    ASSERT_EQ(rows.size(), 1u);
    EXPECT_EQ(rows[0].at("factor_of_safety_post_seismic"), 0.9) << rows;
    EXPECT_EQ(count_tasks(service, run, "post_seismic"), 1);
}

TEST(Trigger, AStabilityAnalysisThatFailedIsNoDamThatStandsAndTheRetryDecides) {
    const Live live;
    make_depths(live);
    const auto fails = live.sandbox.root() / "lem_fails";
    std::ofstream(fails) << "\n";
    Service service(live.sandbox);
    json wanted = of_two_depths({{{"kind", "criterion"},
                                  {"name", "deep"},
                                  {"when", "crest_displacement >= critical_depth"},
                                  {"snapshot_interval_s", 0.1}}});
    wanted.erase("variants");
    const std::string run = service.submit(wanted);
    service.wait_for_end(run, 60);
    const json expired = triggers_of(service, run).at(0);
    EXPECT_EQ(expired.at("state"), "expired") << expired;
    EXPECT_TRUE(expired.at("reason").get<std::string>().starts_with(
        "its stability analysis gave no critical_depth ("))
        << expired;
    EXPECT_TRUE(expired.at("result").is_null()) << expired;
    const json missing = service.get("/v1/runs/" + run + "/results").body.at("without_transfer");
    ASSERT_EQ(missing.size(), 1u);
    EXPECT_EQ(missing[0].at("stood"), false) << missing;

    std::filesystem::remove(fails);
    EXPECT_EQ(service.post("/v1/runs/" + run + "/retry", "").status, 202);
    const json trigger = settled(service, run).at(0);
    ASSERT_EQ(trigger.at("state"), "fired") << trigger;
    EXPECT_NEAR(trigger.at("firings")[0].at("transfer_time"), 1.0, 0.0501);
    EXPECT_EQ(service.table(run).size(), 1u);
}

TEST(Trigger, ABisectIsNotDecidedByARunoutThatTheMachineLost) {
    const Live live;
    // While a file `mpm_fails` exists in the sandbox, the MPM ends as with a full disk.
    const auto fails = live.sandbox.root() / "mpm_fails";
    const auto program = live.sandbox.bin() / "mpm_solver";
    std::ofstream(fails) << "\n";
    std::filesystem::remove(program);
    std::ofstream(program) << R"sh(#!/bin/bash
[ "$1" != --version ] && [ -e "$(dirname "$0")/../mpm_fails" ] && { echo 'the disk is full' >&2; exit 74; }
exec -a "$0" )sh" << (std::filesystem::path(BREACH_BIN) / "fake_phase").string()
                           << " \"$@\"\n";
    std::filesystem::permissions(program, std::filesystem::perms::owner_all);
    Service service(live.sandbox);
    const std::string run = service.submit(
        with_triggers({{{"kind", "bisect"}, {"share", 0.75}, {"tolerance_s", 0.1}, {"seeds", 3}}}));
    service.wait_for_end(run, 60);
    const json expired = triggers_of(service, run).at(0);
    EXPECT_EQ(expired.at("state"), "expired") << expired;
    const std::string reason = expired.at("reason");
    EXPECT_TRUE(reason.starts_with("the runout at ")) << reason;
    EXPECT_NE(reason.find("the disk is full"), std::string::npos) << reason;
    EXPECT_EQ(count_tasks(service, run, "mpm_solver"), 3) << "no halving by what is not known";

    std::filesystem::remove(fails);
    EXPECT_EQ(service.post("/v1/runs/" + run + "/retry", "").status, 202);
    const json trigger = settled(service, run).at(0);
    ASSERT_EQ(trigger.at("state"), "fired") << trigger;
    EXPECT_EQ(trigger.at("result").at("complete"), true);
    EXPECT_NEAR(trigger.at("result").at("lower").at("on"), 1.9, 0.0501);  // 1.838 s
}

TEST(Trigger, OfAFemThatAnExtensionComputedAgainFiresWithItsTransfers) {
    const Live live;
    live.set_exit_code(74);
    Service service(live.sandbox);
    json plain = study("mpm_steps=2", {0.5, 1.0});
    plain["stability"] = false;
    const std::string run = service.submit(plain);
    service.wait_for_end(run, 60);
    live.set_exit_code(0);
    const Answer more = service.post("/v1/sweeps/" + run + "/extend", R"({"transfer_times": [2]})");
    ASSERT_EQ(more.status, 202) << more.text;
    service.wait_for_end(run, 60);
    const std::string path = "/v1/runs/" + run + "/triggers";
    EXPECT_EQ(service
                  .post(path, R"({"kind":"criterion","name":"late","when":"time > 2.5",)"
                              R"("within_s":10})")
                  .status,
              202);
    EXPECT_EQ(
        service.post(path, R"({"kind":"bisect","name":"edges","share":0.75,"seeds":3})").status,
        202);
    ASSERT_TRUE(eventually([&] {
        return std::ranges::all_of(triggers_of(service, run), [](const json& each) {
            return each.at("state") == "fired" || each.at("state") == "expired";
        });
    })) << triggers_of(service, run);
    service.wait_for_end(run, 60);
    const json body = service.get("/v1/runs/" + run).body;
    const std::string again = task_labelled(body, "fem_2").at("id");
    int fired = 0;
    for (const json& each : triggers_of(service, run)) {
        const bool on_the_second = each.at("fem_task") == again;
        EXPECT_EQ(each.at("state"), on_the_second ? "fired" : "expired") << each;
        fired += on_the_second ? 1 : 0;
        if (on_the_second && each.at("kind") == "bisect") {
            EXPECT_EQ(each.at("result").at("runs"), 4) << each;
            EXPECT_EQ(each.at("result").at("complete"), true);
        }
    }
    EXPECT_EQ(fired, 2);
    const json rows = service.table(run);
    ASSERT_EQ(rows.size(), 4u) << "0.5, 1, 2 and 2.8 s: " << rows;
    for (const json& row : rows) EXPECT_EQ(row.at("state"), "succeeded") << row;
    EXPECT_NEAR(rows[3].at("transfer_time"), 2.8, 1e-6);
}

TEST(Trigger, OnACriticalDepthIsRefusedWhereVariantsOfSeveralShareTheFem) {
    const Live live;
    make_depths(live);
    Service service(live.sandbox);
    const json plain{{{"kind", "criterion"}, {"when", "time > 1"}}};
    const json on_depth{
        {"kind", "criterion"}, {"name", "depth"}, {"when", "crest_displacement >= critical_depth"}};
    const std::string run = service.submit(of_two_depths(plain));
    const auto path = [](const std::string& id) { return "/v1/runs/" + id + "/triggers"; };
    const Answer refused = service.post(path(run), on_depth.dump());
    EXPECT_EQ(refused.status, 422) << refused.text;
    EXPECT_NE(refused.text.find("different stability analyses"), std::string::npos) << refused.text;
    json other = on_depth;
    other["when"] = "crest_displacement >= 1";
    EXPECT_EQ(service.post(path(run), other.dump()).status, 202);

    json alike = of_two_depths(plain);
    alike["variants"][1]["overrides"] = {"/mpm/duration=1"};
    const std::string of_one = service.submit(alike);
    const Answer taken = service.post(path(of_one), on_depth.dump());
    EXPECT_EQ(taken.status, 202) << taken.text;
    for (const std::string& each : {run, of_one}) service.wait_for_end(each, 60);
}

}  // namespace
}  // namespace breach::testing
