// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include "bench/peers/fcl_crowd.hpp"

#include <fcl/broadphase/broadphase_SaP.h>
#include <fcl/broadphase/broadphase_dynamic_AABB_tree.h>
#include <fcl/broadphase/broadphase_dynamic_AABB_tree_array.h>
#include <fcl/math/bv/OBBRSS.h>
#include <fcl/narrowphase/collision.h>
#include <fcl/narrowphase/distance.h>

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

template <class Volume>
std::vector<std::unique_ptr<Body>> bodies_of(const scenes::PlacedScene& scene) {
  std::vector<std::shared_ptr<fcl::BVHModel<Volume>>> models;
  for (const scenes::MeshData& mesh : scene.meshes) {
    models.push_back(fcl_model<Volume>(mesh));
    models.back()->computeLocalAABB();
  }
  std::vector<std::unique_ptr<Body>> bodies;
  for (const scenes::PlacedObject& object : scene.objects)
    bodies.push_back(std::make_unique<Body>(models[object.mesh], fcl_transform(object.pose)));
  return bodies;
}

void move_all(std::span<const std::unique_ptr<Body>> bodies, std::span<const Pose> poses) {
  for (std::size_t i = 0; i < poses.size(); ++i) {
    bodies[i]->setTransform(fcl_transform(poses[i]));
    bodies[i]->computeAABB();
  }
}

std::unique_ptr<fcl::BroadPhaseCollisionManagerd> manager_of(FclManager kind,
                                                             std::span<const std::unique_ptr<Body>> bodies) {
  std::unique_ptr<fcl::BroadPhaseCollisionManagerd> manager;
  switch (kind) {
    case FclManager::tree:
      manager = std::make_unique<fcl::DynamicAABBTreeCollisionManagerd>();
      break;
    case FclManager::tree_array:
      manager = std::make_unique<fcl::DynamicAABBTreeCollisionManager_Arrayd>();
      break;
    case FclManager::sweep_and_prune:
      manager = std::make_unique<fcl::SaPCollisionManagerd>();
      break;
  }
  for (const auto& body : bodies) manager->registerObject(body.get());
  manager->setup();
  return manager;
}

/// The first contact ends the manager's search.
struct FirstContact {
  fcl::CollisionRequest<double> request{1, false};
  fcl::CollisionResult<double> result;
};

bool find_contact(Body* a, Body* b, void* data) {
  auto& [request, result] = *static_cast<FirstContact*>(data);
  return fcl::collide(a, b, request, result) > 0;
}

/// What has been found so far bounds each search that follows.
struct LeastDistance {
  fcl::DistanceRequest<double> request{true};
  fcl::DistanceResult<double> result;
};

bool find_distance(Body* a, Body* b, void* data, double& least) {
  auto& [request, result] = *static_cast<LeastDistance*>(data);
  fcl::distance(a, b, request, result);
  least = result.min_distance;
  return least <= 0;
}

}  // namespace

struct FclCrowd::State {
  std::vector<std::unique_ptr<Body>> bodies;
  fcl::DynamicAABBTreeCollisionManagerd manager;
  Round round;
};

FclCrowd::FclCrowd(const scenes::PlacedScene& scene) : state_(std::make_unique<State>()) {
  state_->bodies = bodies_of<fcl::OBB<double>>(scene);
  for (std::uintptr_t i = 0; i < state_->bodies.size(); ++i) {
    state_->bodies[i]->setUserData(reinterpret_cast<void*>(i));
    state_->manager.registerObject(state_->bodies[i].get());
  }
  state_->manager.setup();
}

FclCrowd::~FclCrowd() = default;

void FclCrowd::move(std::span<const Pose> poses) { move_all(state_->bodies, poses); }

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

struct FclRobot::State {
  /// One kind of trees.
  struct Scene {
    std::vector<std::unique_ptr<Body>> obstacles, links;
    std::unique_ptr<fcl::BroadPhaseCollisionManagerd> manager;
  };
  Scene contact, nearness;
  std::vector<std::array<std::uint32_t, 2>> pairs;
  FirstContact first;
  LeastDistance least;
};

FclRobot::FclRobot(FclManager manager, const scenes::PlacedScene& obstacles, const scenes::PlacedScene& links,
                   std::vector<std::array<std::uint32_t, 2>> pairs)
    : state_(std::make_unique<State>()) {
  state_->pairs = std::move(pairs);
  state_->contact = {bodies_of<fcl::OBB<double>>(obstacles), bodies_of<fcl::OBB<double>>(links), nullptr};
  state_->nearness = {bodies_of<fcl::OBBRSS<double>>(obstacles), bodies_of<fcl::OBBRSS<double>>(links), nullptr};
  for (State::Scene* scene : {&state_->contact, &state_->nearness})
    scene->manager = manager_of(manager, scene->obstacles);
}

FclRobot::~FclRobot() = default;

void FclRobot::place(std::span<const Pose> poses) { move_all(state_->contact.links, poses); }

void FclRobot::move_obstacle(std::size_t i, const Pose& pose) {
  Body& body = *state_->contact.obstacles[i];
  body.setTransform(fcl_transform(pose));
  body.computeAABB();
  state_->contact.manager->update(&body);
}

bool FclRobot::touches(std::span<const Pose> poses) {
  const auto& links = state_->contact.links;
  FirstContact& first = state_->first;
  first.result.clear();
  place(poses);
  for (const auto& link : links) {
    state_->contact.manager->collide(link.get(), &first, find_contact);
    if (first.result.isCollision()) return true;
  }
  for (const auto& [i, k] : state_->pairs)
    if (links[i]->getAABB().overlap(links[k]->getAABB()) && find_contact(links[i].get(), links[k].get(), &first))
      return true;
  return false;
}

double FclRobot::distance(std::span<const Pose> poses) {
  const auto& links = state_->nearness.links;
  LeastDistance& least = state_->least;
  least.result.clear();
  move_all(links, poses);
  for (const auto& link : links) {
    state_->nearness.manager->distance(link.get(), &least, find_distance);
    if (least.result.min_distance <= 0) return 0;
  }
  double known = least.result.min_distance;
  for (const auto& [i, k] : state_->pairs)
    if (links[i]->getAABB().distance(links[k]->getAABB()) < known)
      find_distance(links[i].get(), links[k].get(), &least, known);
  return std::max(known, 0.0);
}

}  // namespace impinge::bench
