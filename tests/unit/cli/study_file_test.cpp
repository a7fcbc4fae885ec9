#include "services/cli/study_file.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <fstream>
#include <nlohmann/json.hpp>

#include "core/fault/fault.hpp"

namespace breach::cli {

namespace fs = std::filesystem;

class StudyFile : public testing::Test {
  protected:
    StudyFile() { fs::create_directories(folder_ / "scenes"); }
    ~StudyFile() override { fs::remove_all(folder_); }

    fs::path write(const std::string& name, const std::string& text) const {
        std::ofstream(folder_ / name) << text;
        return folder_ / name;
    }

    fs::path folder_ = fs::temp_directory_path() / ("study_file_test_" + std::to_string(getpid()));
};

TEST_F(StudyFile, GetsTheSceneThatItNamesRelativeToItself) {
    write("scenes/slope.json", R"({"name": "slope", "fem": {"msh_file": "../mesh/slope.msh"}})");
    const auto study = read_study(write("study.json", R"({"scene": "scenes/slope.json"})"), {});
    EXPECT_EQ(study["scene"]["name"], "slope");
    EXPECT_EQ(study["scene"]["fem"]["msh_file"], (folder_ / "mesh/slope.msh").string());
}

TEST_F(StudyFile, ResolvesPathsInTheRungsOfAnAccuracyStudy) {
    write("scenes/dam.json", R"({"name": "dam"})");
    const auto study = read_study(
        write("study.json",
              R"({"scene": "scenes/dam.json", "accuracy": {"base": ["/fem/motion/file=m.csv"],
            "ladders": [{"steps": [["/fem/msh_file=coarse.msh"], ["/fem/msh_file=/fine.msh"]]}]}})"),
        {});
    const std::string scenes = (folder_ / "scenes").string();
    EXPECT_EQ(study["accuracy"]["base"][0], "/fem/motion/file=" + scenes + "/m.csv");
    EXPECT_EQ(
        study["accuracy"]["ladders"][0]["steps"],
        nlohmann::json({{"/fem/msh_file=" + scenes + "/coarse.msh"}, {"/fem/msh_file=/fine.msh"}}));
}

TEST_F(StudyFile, ResolvesPathsInOverridesLikeTheEntriesThatTheyReplace) {
    write("scenes/dam.json", R"({"name": "dam"})");
    const auto study = read_study(
        write("study.json", R"({"scene": "scenes/dam.json", "overrides": ["/fem/msh_file=a.msh"],
            "variants": [{"name": "b", "overrides": ["/fem/motion/file=../b.csv", "/x=../c"]}]})"),
        {"/fem/motion/file=/d.csv"});
    const std::string scenes = (folder_ / "scenes").string();
    EXPECT_EQ(study["overrides"],
              nlohmann::json({"/fem/msh_file=" + scenes + "/a.msh", "/fem/motion/file=/d.csv"}));
    EXPECT_EQ(study["variants"][0]["overrides"],
              nlohmann::json({"/fem/motion/file=" + (folder_ / "b.csv").string(), "/x=../c"}));
}

TEST_F(StudyFile, ListsWhatVariantsOverrule) {
    const auto study = nlohmann::json::parse(
        R"({"variants": [{"name": "soft", "overrides": ["/materials/t/law/c_kPa=4"]},
                         {"name": "stages", "overrides": ["/fem/stages=[]", "/mpm/cfl=0.4"]}, {"name": "plain"}, 3]})");
    EXPECT_EQ(
        overruled(study, {"/materials/t/law/c_kPa=12", "/fem/stages/2/time_step=1",
                          "/mpm/cell_size=1", "/materials=1"}),
        (std::vector<std::string>{
            "/materials/t/law/c_kPa is set by variants themselves, which keep their own: soft",
            "/fem/stages/2/time_step is set by variants themselves, which keep their own: "
            "stages"}));
    EXPECT_TRUE(overruled(nlohmann::json::array(), {"/a=1"}).empty());
}

TEST_F(StudyFile, KeepsASceneThatIsInline) {
    const auto study = read_study(write("study.json", R"({"scene": {"name": "x"}})"), {"/a=1"});
    EXPECT_EQ(study["scene"]["name"], "x");
    EXPECT_EQ(study["overrides"], nlohmann::json({"/a=1"}));
}

TEST_F(StudyFile, AddsOverridesBehindItsOwn) {
    const auto study = read_study(write("study.json", R"({"overrides": ["/a=1"]})"), {"/a=2"});
    EXPECT_EQ(study["overrides"], nlohmann::json({"/a=1", "/a=2"}));
}

TEST_F(StudyFile, LeavesTheJudgementToTheServer) {
    EXPECT_EQ(read_study(write("study.json", "[1]"), {}), nlohmann::json({1}));
    EXPECT_EQ(
        read_study(write("study.json", R"({"scene": 3, "overrides": 4})"), {"/a=1"})["overrides"],
        4);
}

TEST_F(StudyFile, RefusesWhatIsNoFileOrNoJson) {
    EXPECT_THROW(read_study(folder_ / "absent.json", {}), fault::IoError);
    EXPECT_THROW(read_study(folder_, {}), fault::IoError);
    EXPECT_THROW(read_study(write("study.json", R"({"scene": "absent.json"})"), {}),
                 fault::IoError);
    EXPECT_THROW(read_study(write("study.json", R"({"a": 1, "a": 2})"), {}), fault::BadInput);
}

}  // namespace breach::cli
