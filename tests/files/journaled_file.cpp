#include "files/journaled_file.hpp"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <random>

#include "block_mesh.hpp"
#include "failure.hpp"
#include "read_back.hpp"
#include "slipscale/base/error.hpp"

using namespace slipscale;
using testing_support::failure_of;
using testing_support::scratch;

namespace {

std::string content(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

void replace(const std::string& path, const std::string& text) {
  std::ofstream(path, std::ios::binary | std::ios::trunc) << text;
}

std::string file_with(const std::string& name, const std::string& text) {
  const std::string path = scratch(name);
  replace(path, text);
  return path;
}

std::vector<std::byte> bytes_of(const std::string& text) {
  std::vector<std::byte> bytes(text.size());
  std::transform(text.begin(), text.end(), bytes.begin(), [](char c) { return std::byte(c); });
  return bytes;
}

/// A journal as a process leaves it that is killed while it commits, to the file `path`.
std::string journal_on_disk(const std::string& path, const Extents& changes, std::uint64_t size) {
  const int file = open(Journal::path(path).c_str(), O_RDWR | O_CREAT | O_TRUNC, 0666);
  EXPECT_TRUE(Journal(changes, size).save(file));
  close(file);
  return content(Journal::path(path));
}

const Extents changes{{0, bytes_of("AB")}, {4, bytes_of("E")}, {5, bytes_of("F")}};

}  // namespace

TEST(JournaledFile, IsTheLastCommittedStateUntilTheNext) {
  std::mt19937 random(7);
  const auto number = [&](std::size_t below) {
    return std::uniform_int_distribution<std::size_t>(0, below - 1)(random);
  };
  const std::string path = file_with("random", std::string(1000, '.'));
  std::string committed(1000, '.');
  {
    JournaledFile file(path, O_RDWR);
    for (int round = 0; round < 200; ++round) {
      std::string wanted = committed;
      for (int k = 0; k < 20; ++k) {
        const std::size_t at = number(wanted.size() + 30), size = 1 + number(50);
        const std::string text(size, static_cast<char>('a' + number(26)));
        wanted.resize(std::max(wanted.size(), at + size), '\0');
        wanted.replace(at, size, text);
        file.write(at, size, text.data());
      }
      ASSERT_EQ(file.size(), wanted.size());
      std::string seen(wanted.size(), '?');
      ASSERT_TRUE(file.read(0, seen.size(), seen.data()));
      ASSERT_EQ(seen, wanted);
      ASSERT_EQ(content(path).substr(0, committed.size()), committed);
      if (round % 7 == 3) wanted.resize(wanted.size() - number(wanted.size() / 2));  // it may shrink
      file.commit(wanted.size());
      ASSERT_EQ(content(path).substr(0, wanted.size()), wanted);
      JournaledFile::recover(path, false);  // as a reader would: there is nothing to do
      ASSERT_EQ(content(path).substr(0, wanted.size()), wanted);
      committed = wanted;
    }
    file.write(0, 3, "not");
  }
  EXPECT_EQ(content(path), committed);
  EXPECT_FALSE(std::filesystem::exists(Journal::path(path)));
}

TEST(JournaledFile, AKillWhileItCommitsIsMadeGood) {
  const std::string path = file_with("killed", "abcdefgh");
  const std::string journal = journal_on_disk(path, changes, 8);
  for (const std::string torn : {"abcdefgh", "Abcdefgh", "ABcdefgh", "ABcdEfgh", "ABcdEFgh"}) {
    replace(path, torn);
    replace(Journal::path(path), journal + "the end of a longer one before it");
    JournaledFile::recover(path, false);
    EXPECT_EQ(content(path), "ABcdEFgh");
    EXPECT_FALSE(std::filesystem::exists(Journal::path(path)));
  }
}

TEST(JournaledFile, AJournalThatIsNotWholeChangesNothing) {
  const std::string path = file_with("torn", "abcdefgh");
  const std::string journal = journal_on_disk(path, changes, 8);
  std::vector<std::string> damaged{std::string(journal.size(), '\0')};
  for (std::size_t length = 0; length < journal.size(); ++length)
    damaged.push_back(journal.substr(0, length));
  for (std::size_t k = 0; k < journal.size(); ++k) {
    damaged.push_back(journal);
    damaged.back()[k] = static_cast<char>(damaged.back()[k] ^ 0x40);
  }
  for (const std::string& bad : damaged) {
    replace(Journal::path(path), bad);
    JournaledFile::recover(path, false);
    EXPECT_TRUE(std::filesystem::exists(Journal::path(path)));
    JournaledFile::recover(path, true);
    EXPECT_FALSE(std::filesystem::exists(Journal::path(path)));
    ASSERT_EQ(content(path), "abcdefgh");
  }
}

TEST(JournaledFile, WhatSomebodyIsAtWorkOnOrIsOfAnotherFileIsLeftAlone) {
  const std::string path = file_with("locked", "abcdefgh");
  journal_on_disk(path, changes, 8);
  const int writer = open(Journal::path(path).c_str(), O_WRONLY);
  ASSERT_EQ(flock(writer, LOCK_EX), 0);
  JournaledFile::recover(path, false);
  EXPECT_EQ(content(path), "abcdefgh");
  close(writer);
  replace(path, "abc");
  JournaledFile::recover(path, false);
  EXPECT_EQ(content(path), "abc");
  JournaledFile::recover(path + ".none", true);
}

TEST(JournaledFile, AWriteThatFailsLeavesTheCommittedState) {
  const std::string path = file_with("full", std::string(1000, '.'));
  {
    const read_back::SmallDisk disk(1200);
    JournaledFile file(path, O_RDWR);
    const std::string text(500, 'x');
    file.write(0, 10, text.data());
    file.write(1000, 500, text.data());
    EXPECT_EQ(*file.failure(), "File too large");
    file.commit(1500);
    std::string seen(1500, '?');
    ASSERT_TRUE(file.read(0, 1500, seen.data()));
    EXPECT_EQ(seen, std::string(10, 'x') + std::string(990, '.') + text);
  }
  EXPECT_EQ(content(path), std::string(1000, '.'));
}

TEST(JournaledFile, GoesOnWhereTheJournalHasNoRoom) {
  const std::string path = file_with("narrow", std::string(3000, '.'));
  JournaledFile file(path, O_RDWR);
  const std::string text(1000, 'x');
  file.write(0, 1000, text.data());
  ASSERT_EQ(mkdir(Journal::path(path).c_str(), 0777), 0);  // no file can have this name
  file.commit(3000);
  EXPECT_EQ(*file.failure(), "");
  EXPECT_EQ(content(path), text + std::string(2000, '.'));
}

TEST(JournaledFile, SaysWhyItCannotBeOpened) {
  EXPECT_EQ(failure_of<LibraryError>([] { JournaledFile("/nowhere/at/all", O_RDWR); }),
            "No such file or directory");
}
