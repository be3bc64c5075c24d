// SPDX-License-Identifier: BSD-3-Clause
#include "io/atomic_file.h"

#include "temporary_directory.h"

#include <csignal>

namespace pds
{
namespace
{

using Names = std::vector<std::string>;

class AtomicFileTest : public TemporaryDirectory
{
};

TEST_F(AtomicFileTest, appears_when_it_is_complete)
{
  AtomicFile file(path("a"));
  file.write("hello", 5);
  EXPECT_FALSE(std::filesystem::exists(path("a")));
  file.finish();
  file.commit();
  EXPECT_EQ(files(), Names{"a"});
  EXPECT_EQ(read("a"), "hello");
}

TEST_F(AtomicFileTest, leaves_nothing_behind_and_the_old_file_as_it_was)
{
  write("a", "old");
  {
    AtomicFile file(path("a"));
    file.write("new", 3);
    file.finish();
  }
  EXPECT_EQ(files(), Names{"a"});
  EXPECT_EQ(read("a"), "old");
}

TEST_F(AtomicFileTest, replaces_what_a_link_points_to)
{
  write("target", "old");
  std::filesystem::create_symlink(path("target"), path("link"));
  AtomicFile file(path("link"));
  file.write("new", 3);
  file.finish();
  file.commit();
  EXPECT_TRUE(std::filesystem::is_symlink(path("link")));
  EXPECT_EQ(read("target"), "new");
}

TEST_F(AtomicFileTest, is_removed_by_signals)
{
  testing::FLAGS_gtest_death_test_style = "threadsafe";
  for (const int signal : {SIGINT, SIGTERM}) {
    const std::string target = write("a", "old");
    EXPECT_EXIT(
        {
          AtomicFile file(target);
          file.write("new", 3);
          file.finish();
          std::raise(signal);
        },
        testing::KilledBySignal(signal), "");
    EXPECT_EQ(files(), Names{"a"});
    EXPECT_EQ(read("a"), "old");
  }
}

TEST_F(AtomicFileTest, is_checked_without_a_trace)
{
  EXPECT_NO_THROW(check_writable(path("a")));
  EXPECT_TRUE(files().empty());
  EXPECT_THROW(check_writable(path("no_directory/a")), OutputError);
  EXPECT_THROW(check_writable(path(".")), OutputError);
  EXPECT_THROW(check_writable("/dev/null"), OutputError);
}

}  // namespace
}  // namespace pds
