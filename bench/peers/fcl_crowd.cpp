// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include "bench/peers/fcl_crowd.hpp"

#include <fcl/broadphase/broadphase_dynamic_AABB_tree.h>
#include <fcl/narrowphase/collision.h>

#include <algorithm>
#include <limits>

#include "bench/peers/fcl_types.hpp"

namespace impinge::bench {
namespace {

using Body = fcl::CollisionObject<double>;

/// FCL keeps no numbers of bodies: the user data holds them.
std::uint32_t number_of(const Body* body) {
  return static_cast<std::uint32_t>(reinterpret_cast<std::uintptr_t>(body->getUserData()));
}

struct Meeting {
  std::uint32_t a, b;
  std::size_t first_contact, contacts;
};

/// What a round of callbacks collects. One result for all pairs, as FCL's own default callback keeps it.
struct Round {
  fcl::CollisionRequest<double> request{std::numeric_limits<std::size_t>::max(), false};
  fcl::CollisionResult<double> result;
  std::vector<Meeting> meetings;
  std::size_t pairs = 0;
};

bool count_pair(Body*, Body*, void* round) {
  ++static_cast<Round*>(round)->pairs;
  return false;  // go on
}

bool collide_pair(Body* a, Body* b, void* data) {
  Round& round = *static_cast<Round*>(data);
  const std::size_t before = round.result.numContacts();
  fcl::collide(a, b, round.request, round.result);
  const std::size_t found = round.result.numContacts() - before;
  if (found > 0) round.meetings.push_back({number_of(a), number_of(b), before, found});
  return false;
}

}  // namespace

struct FclCrowd::State {
  std::vector<std::unique_ptr<Body>> bodies;
  fcl::DynamicAABBTreeCollisionManagerd manager;
  Round round;
};

FclCrowd::FclCrowd(const scenes::PlacedScene& scene) : state_(std::make_unique<State>()) {
  std::vector<std::shared_ptr<FclModel>> models;
  for (const scenes::MeshData& mesh : scene.meshes) {
    models.push_back(fcl_model(mesh));
    models.back()->computeLocalAABB();
  }
  for (const scenes::PlacedObject& object : scene.objects) {
    auto body = std::make_unique<Body>(models[object.mesh], fcl_transform(object.pose));
    body->setUserData(reinterpret_cast<void*>(static_cast<std::uintptr_t>(state_->bodies.size())));
    state_->manager.registerObject(body.get());
    state_->bodies.push_back(std::move(body));
  }
  state_->manager.setup();
}

FclCrowd::~FclCrowd() = default;

void FclCrowd::move(std::span<const Pose> poses) {
  for (std::size_t i = 0; i < poses.size(); ++i) {
    state_->bodies[i]->setTransform(fcl_transform(poses[i]));
    state_->bodies[i]->computeAABB();
  }
}

std::size_t FclCrowd::broad_phase() {
  state_->round.pairs = 0;
  state_->manager.update();
  state_->manager.collide(&state_->round, count_pair);
  return state_->round.pairs;
}

std::size_t FclCrowd::collide(bool with_points) {
  state_->round.request.enable_contact = with_points;
  state_->round.result.clear();
  state_->round.meetings.clear();
  state_->manager.update();
  state_->manager.collide(&state_->round, collide_pair);
  return state_->round.result.numContacts();
}

std::vector<std::array<std::uint32_t, 4>> FclCrowd::contacts() const {
  std::vector<std::array<std::uint32_t, 4>> contacts;
  for (const Meeting& meeting : state_->round.meetings)
    for (std::size_t i = 0; i < meeting.contacts; ++i) {
      const auto& contact = state_->round.result.getContact(meeting.first_contact + i);
      const auto b1 = static_cast<std::uint32_t>(contact.b1), b2 = static_cast<std::uint32_t>(contact.b2);
      if (meeting.a < meeting.b)
        contacts.push_back({meeting.a, meeting.b, b1, b2});
      else
        contacts.push_back({meeting.b, meeting.a, b2, b1});
    }
  std::sort(contacts.begin(), contacts.end());
  return contacts;
}

}  // namespace impinge::bench
