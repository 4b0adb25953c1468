#include "gsv/campaign/engine.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "gsv/scenario/yaml_mapping.h"

namespace gsv::campaign {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

class EngineTest : public ::testing::Test {
 protected:
  Engine Read(const std::string& text, const EngineRequest& request = {}) {
    problems_.clear();
    const scenario::YamlPlace place(scenario::YamlPlace::Naming::kLines, "c.yaml", problems_);
    scenario::YamlMapping mapping(YAML::Load(text), "", place);
    return ReadEngine(mapping, request);
  }
  std::string Problems() const {
    std::string text;
    for (const base::Problem& problem : problems_) text += problem.Sentence() + "\n";
    return text;
  }

  base::Problems problems_;
};

TEST_F(EngineTest, DefaultRunsInThisProcess) {
  const Engine engine = Read("{}");
  EXPECT_EQ(engine.type->name, "local");
  EXPECT_FALSE(engine.make_queue);
  EXPECT_EQ(Problems(), "");
}

TEST_F(EngineTest, FileNamesTheEngineAndItsKeys) {
  const Engine engine = Read("engine: slurm\nslurm: {partition: short, runs_per_task: 10}");
  EXPECT_EQ(engine.type->title, "Slurm");
  EXPECT_TRUE(engine.make_queue);
  EXPECT_EQ(engine.runs_per_task, 10u);
  EXPECT_EQ(Problems(), "");
}

TEST_F(EngineTest, FormerNameOfRunsPerTaskIsAccepted) {
  EXPECT_EQ(Read("engine: slurm\nslurm: {runs_a_task: 10}").runs_per_task, 10u);
  EXPECT_EQ(Problems(), "");
}

TEST_F(EngineTest, CommandLineOverridesTheFile) {
  EngineRequest request{.name = "ssh", .runs_per_task = 3};
  request.options["--host"] = {"n2:4"};
  const Engine engine = Read("engine: slurm\nssh: {hosts: [n1], runs_per_task: 10}", request);
  EXPECT_EQ(engine.type->name, "ssh");
  EXPECT_EQ(engine.runs_per_task, 3u);
  EXPECT_EQ(Problems(), "");
  // The file has no mapping for the engine, so only the options of the command line apply.
  EXPECT_TRUE(Read("{}", request).make_queue);
  EXPECT_EQ(Problems(), "");
  EXPECT_FALSE(Read("engine: slurm", {.name = "local"}).make_queue);
}

TEST_F(EngineTest, ProblemsNameThePlaceOfEachError) {
  const std::pair<const char*, const char*> bad[]{
      {"engine: pbs",
       "c.yaml:1:9: there is no engine \"pbs\"; the engines are local, slurm or ssh"},
      {"slurm: {queue: short}", "c.yaml:1:9: there is no key \"queue\" here"},
      {"slurm: {runs_per_task: 0}", "c.yaml:1:24: runs_per_task must be"},
      {"slurm: {runs_per_task: 1, runs_a_task: 1}",
       "runs_a_task is the former name of runs_per_task"},
      {"engine: ssh", "c.yaml: hosts must be a list of 1 to 1,000 hosts, such as [n1, user@n2:8]"},
      {"ssh: {hosts: []}", "c.yaml:1:14: hosts must be a list of 1 to 1,000 hosts"},
      {"ssh: {hosts: n1}", "hosts must be a list, found \"n1\""},
      {"ssh: {hosts: [n1, 'n2:0']}",
       "a host must have the form HOST or HOST:SLOTS with 1 to 256 slots"},
      {"ssh: {hosts: ['n2:']}", "found \"n2:\""},
      {"ssh: {hosts: ['n2:1x']}", "found \"n2:1x\""},
      {"ssh: {hosts: ['n2:257']}", "found \"n2:257\""},
      {"ssh: {hosts: ['fe80::1']}", "found \"fe80::1\""},
      {"ssh: {hosts: ['-oProxyCommand=x']}", "found \"-oProxyCommand=x\""},
      {"ssh: {hosts: ['a b']}", "found \"a b\""},
      {"ssh: {hosts: ['../n1']}", "found \"../n1\""},
      {"ssh: {hosts: [n1], port: 22}", "there is no key \"port\" here"},
      {"ssh: n1", "expected a mapping"}};
  for (const auto& [text, sentence] : bad) {
    Read(text);
    EXPECT_THAT(Problems(), HasSubstr(sentence)) << text;
  }
}

TEST_F(EngineTest, OptionsOnAMalformedMappingAreAProblem) {
  EngineRequest request{.name = "slurm"};
  request.options["--partition"] = {"short"};
  request.options["--sbatch"] = {"--mem=2G"};
  Read("slurm: 3", request);
  EXPECT_THAT(Problems(), HasSubstr("expected a mapping"));
  Read("slurm: {options: --mem=1G}", request);
  EXPECT_THAT(Problems(), HasSubstr("options must be a list"));
}

TEST(EngineTypes, NamesAndFlagsAreUnique) {
  std::vector<std::string> names;
  for (const EngineType& type : EngineTypes()) {
    names.push_back(type.name);
    EXPECT_FALSE(type.title.empty());
    EXPECT_FALSE(type.help.empty());
    EXPECT_EQ(type.read == nullptr, type.after_interrupt.empty()) << type.name;
  }
  EXPECT_THAT(names, ElementsAre("local", "slurm", "ssh"));
}

}  // namespace
}  // namespace gsv::campaign
