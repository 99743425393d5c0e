#include "canopeer/map/storage/page_pool.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <cstring>
#include <set>
#include <thread>
#include <vector>

namespace canopeer {
namespace {

constexpr std::size_t kBytes = 30'000;

TEST(PagePool, PagesAreAlignedAndDoNotOverlap) {
  PagePool pool(kBytes);
  std::vector<void*> pages;
  for (int i = 0; i < 200; ++i) pages.push_back(pool.take());  // three slabs
  for (std::size_t i = 0; i < pages.size(); ++i) {
    EXPECT_EQ(reinterpret_cast<std::uintptr_t>(pages[i]) % 64, 0U);
    std::memset(pages[i], static_cast<int>(i), kBytes);
  }
  for (std::size_t i = 0; i < pages.size(); ++i) {
    const auto* bytes = static_cast<const unsigned char*>(pages[i]);
    EXPECT_EQ(bytes[0], i);
    EXPECT_EQ(bytes[kBytes - 1], i);
  }
  for (void* page : pages) pool.give_back(page);
}

TEST(PagePool, WhatIsGivenBackIsHandedOutAgain) {
  PagePool pool(kBytes);
  std::set<void*> first;
  for (int i = 0; i < 60; ++i) first.insert(pool.take());
  for (void* page : first) pool.give_back(page);
  std::set<void*> second;
  for (int i = 0; i < 60; ++i) second.insert(pool.take());
  EXPECT_EQ(first, second);
  for (void* page : second) pool.give_back(page);
}

TEST(PagePool, MoreSlabsThanAreKeptGoBackToTheSystem) {
  PagePool pool(std::size_t{900'000});  // two pages a slab
  std::vector<void*> pages;
  for (int round = 0; round < 3; ++round) {
    for (int i = 0; i < 60; ++i) pages.push_back(pool.take());
    for (void* page : pages) std::memset(page, round, 900'000);
    for (void* page : pages) pool.give_back(page);
    pages.clear();
  }
}

TEST(PagePool, ServesSeveralThreads) {
  PagePool pool(kBytes);
  const auto work = [&pool](unsigned char mark) {
    for (int round = 0; round < 20; ++round) {
      std::vector<void*> pages;
      for (int i = 0; i < 100; ++i) pages.push_back(std::memset(pool.take(), mark, kBytes));
      for (void* page : pages) {
        EXPECT_EQ(*static_cast<unsigned char*>(page), mark);
        pool.give_back(page);
      }
    }
  };
  std::jthread one(work, static_cast<unsigned char>(1));
  std::jthread two(work, static_cast<unsigned char>(2));
}

}  // namespace
}  // namespace canopeer
