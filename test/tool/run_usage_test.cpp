// SPDX-License-Identifier: BSD-3-Clause
#include "run_testing.h"

namespace pds
{
namespace
{

class RunUsage : public RunTool
{
};

TEST_F(RunUsage, help_and_version_go_to_stdout)
{
  EXPECT_EQ(run("--help"), 0);
  EXPECT_EQ(output().rfind("Usage: pcl_pds_recon", 0), 0U);
  EXPECT_EQ(errors(), "");
  EXPECT_EQ(run("--version"), 0);
  EXPECT_EQ(output().rfind("pcl_pds_recon ", 0), 0U);
}

TEST_F(RunUsage, errors_exit_with_2_and_one_line)
{
  write("in.xyz", "1 2 3\n");
  write("bad.ini", "bogus = 1\n");
  for (const auto& [arguments, part] : std::vector<std::pair<std::string, std::string>>{
           {"", "INPUT"},
           {"in.xyz", "OUTPUT"},
           {"--bogus in.xyz out.ply", "bogus"},
           {"-k 3x in.xyz out.ply", "--k-neighbors"},
           {"-f abc in.xyz out.ply", "--radius-factor"},
           {"-r -1 in.xyz out.ply", "--radius "},
           {"-a nan in.xyz out.ply", "--adaptive"},
           {"--config bad.ini in.xyz out.ply", "bad.ini: unknown option 'bogus'"},
           {"in.xyz out.wrl", ".wrl"},
           {"in.xyz out.ply.gz",
            "out.ply.gz: meshes are not compressed; do so behind: pcl_pds_recon scan.ply - | gzip"},
           {"-q3 in.xyz out.ply", "'-q3': -q takes no value; only letters of other options may follow it"},
           {"-q=3 in.xyz out.ply", "-q takes no value"},
           {"in.xyz in.xyz", "in.xyz"}}) {
    EXPECT_EQ(run(arguments), 2) << arguments;
    EXPECT_TRUE(complained_of(part)) << arguments;
  }
  EXPECT_EQ(files(), (std::vector<std::string>{"bad.ini", "in.xyz"}));
  EXPECT_EQ(read("in.xyz"), "1 2 3\n");
}

}  // namespace
}  // namespace pds
