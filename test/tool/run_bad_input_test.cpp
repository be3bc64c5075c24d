// SPDX-License-Identifier: BSD-3-Clause
#include "run_testing.h"

namespace pds
{
namespace
{

using Names = std::vector<std::string>;

class RunBadInput : public RunTool
{
};

TEST_F(RunBadInput, is_named_in_one_line_and_leaves_no_output)
{
  const std::string ply_header =
      "ply\nformat binary_little_endian 1.0\nelement vertex 1000000000000\nproperty float x\n"
      "property float y\nproperty float z\nend_header\n";
  write("empty.ply", "");
  write("header.ply",
        "ply\nformat ascii 1.0\nelement vertex 0\nproperty float x\nproperty float y\nproperty float z\n"
        "end_header\n");
  write("lying.ply", ply_header + "123456789012");
  write("no_z.csv", "x,y\n1,2\n");
  write("comment.txt", "# nothing\n");
  write("nan.xyz", "nan nan nan\nnan nan nan\n");
  write("one.xyz", "1 2 3\n");
  write("line.xyz", "0 0 0\n1 1 1\n2 2 2\n3 3 3\n4 4 4\n5 5 5\n6 6 6\n7 7 7\n");
  write("cloud.las", "LASF");
  write("empty.las", "");
  write("empty.laz", "");
  write("text.laz", "1 2 3\n");
  write("text.e57", "1 2 3\n");
  write("cloud", "1 2 3\n");
  write("broken.pcd", "# .PCD v0.7\n");
  std::filesystem::create_directory(path("directory.ply"));
  const Names before = files();
  for (const char* name : {"empty.ply", "header.ply", "lying.ply", "no_z.csv", "comment.txt", "nan.xyz", "one.xyz",
                           "line.xyz", "cloud.las", "empty.las", "empty.laz", "text.laz", "text.e57", "cloud",
                           "broken.pcd", "directory.ply", "missing.ply"}) {
    EXPECT_EQ(run(std::string("-q ") + name + " out.ply"), 1) << name;
    EXPECT_TRUE(complained_of(std::string(name) + ": ")) << name;
    EXPECT_TRUE(complained_of("; ")) << name << ": how to mend it";
    EXPECT_EQ(files(), before) << name;
  }
}

TEST_F(RunBadInput, that_is_compressed_is_told_how_to_be_read)
{
  write("cloud.ply.gz", "\x1f\x8b");
  EXPECT_EQ(run("-q cloud.ply.gz out.ply"), 1);
  EXPECT_TRUE(
      complained_of("cloud.ply.gz: is compressed; unpack it on the way: gunzip -c scan.ply.gz | pcl_pds_recon -"));
}

TEST_F(RunBadInput, with_control_characters_is_shown_in_one_line_that_a_terminal_does_not_obey)
{
  write("a\nb\x1b[2J.xyz", "x y z\n");
  EXPECT_EQ(run("-q a*.xyz out.ply"), 1);
  EXPECT_TRUE(complained_of("a\\nb\\x1b[2J.xyz: "));
  write("value.ply",
        "ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nproperty float y\nproperty float z\n"
        "end_header\n1 2 \x1b]0;title\x07\xc2\x9b\x8f\xc3\xa4\n");
  EXPECT_EQ(run("-q value.ply out.ply"), 1);
  EXPECT_TRUE(complained_of("'\\x1b]0;title\\x07\\x9b\\x8f\xc3\xa4'"));
}

TEST_F(RunBadInput, whose_coordinates_are_wild_is_not_blamed_on_the_options)
{
  write("wild.xyz", "0 0 0\n1e30 1 0\n1 1e20 1\n2 1 1\n3 0 1\n");
  EXPECT_EQ(run("-q wild.xyz out.ply"), 1);
  EXPECT_TRUE(
      complained_of("wild.xyz: no mesh came out of 5 points: x reaches from 0 to 1e+30, but of half of the points "
                    "only from 1 to 3"));
}

TEST_F(RunBadInput, which_may_not_be_read)
{
  if (geteuid() == 0) {
    GTEST_SKIP() << "root may read every file";
  }
  write("in.xyz", "1 2 3\n");
  std::filesystem::permissions(path("in.xyz"), std::filesystem::perms::none);
  EXPECT_EQ(run("-q in.xyz out.ply"), 1);
  EXPECT_TRUE(complained_of("permissions"));
}

class RunBadOutput : public RunTool
{
 protected:
  RunBadOutput() { write("in.xyz", sphere_rows(4000, 1, 0, 0)); }
};

TEST_F(RunBadOutput, that_cannot_be_made_is_found_before_the_work)
{
  for (const char* arguments :
       {"in.xyz missing/out.ply", "--report missing/r.json in.xyz out.ply", "--voronoi missing/v.ply in.xyz out.ply",
        "--save-config missing/c.ini in.xyz out.ply"}) {
    EXPECT_EQ(run(arguments), 1) << arguments;
    EXPECT_TRUE(complained_of("no directory")) << arguments;  // a stage would have been logged before
    EXPECT_EQ(files(), Names{"in.xyz"}) << arguments;
  }
  std::filesystem::create_directory(path("out.ply"));
  EXPECT_EQ(run("in.xyz out.ply"), 1);
  EXPECT_TRUE(complained_of("out.ply"));
}

TEST_F(RunBadOutput, that_outgrows_the_disk_leaves_nothing)
{
  for (const char* extension : {"ply", "obj", "stl"}) {
    const std::string name = std::string("out.") + extension;
    EXPECT_EQ(run("-q in.xyz " + name, "ulimit -f 1;"), 1) << name;
    EXPECT_TRUE(complained_of(name + ": cannot be written")) << name;
    EXPECT_EQ(files(), Names{"in.xyz"}) << name;
  }
}

TEST_F(RunBadOutput, of_one_file_keeps_back_the_others)
{
  // The mesh fits below the limit of file sizes, the cloud of all points does not.
  EXPECT_EQ(run("-q -f 6 --voronoi v.ply in.xyz out.ply", "ulimit -f 32;"), 1);
  EXPECT_TRUE(complained_of("v.ply: cannot be written"));
  EXPECT_EQ(files(), Names{"in.xyz"});
}

}  // namespace
}  // namespace pds
