# The bugs: mutant NAME ORACLE FILE FROM TO; see mutation.sh. ORACLE must see it, others may.

# The scalar walk, and what both codes share.
mutant sign_of_g slab_forward walk/random_walk.h 'sample_henyey_greenstein(g, u1)' 'sample_henyey_greenstein(-g, u1)'
mutant sigma_t_3_percent_high slab_unscattered walk/random_walk.h \
  'sample_free_path(sigma, random.next_fine())' 'sample_free_path(Real(1.03) * sigma, random.next_fine())'
mutant exit_1_percent_short mean_path walk/analytic_worlds.h \
  'std::max(b > 0 ? -c / (b + root) : root - b, Real(0));' \
  'Real(0.99) * std::max(b > 0 ? -c / (b + root) : root - b, Real(0));'
mutant albedo_at_the_exit_too half_space walk/random_walk.h \
  'return {WalkEnd::exited, crossing};' 'walker.weight.albedo *= medium.albedo; return {WalkEnd::exited, crossing};'
mutant roulette_without_factor half_space walk/path_weight.h 'throughput /= survival;' ''
mutant half_circle_azimuth infinite_moments walk/random_walk.h 'sample_azimuth(u2)' 'sample_azimuth(Real(0.5) * u2)'
mutant fixed_frame slab_oblique walk/random_walk.h 'make_frame(walker.direction)' 'make_frame(Vec3(0, 0, -1))'
mutant uniform_entry sphere_diffuse render/measured_walk.h \
  'std::sqrt(1 - double{random.next()})' '(1 - double{random.next()})'
mutant capped_at_50 half_space_bright walk/random_walk.h \
  '++walker.weight.order;' 'if (++walker.weight.order == 50) return {WalkEnd::absorbed, crossing};'
mutant fresnel_swapped sphere_fresnel render/measured_walk.h 'eval_fresnel(cosine, ior)' 'eval_fresnel(cosine, 1 / ior)'
mutant eta_squared_missing mean_path_fresnel render/measured_walk.h \
  'static_cast<Real>(1 / job_.ior))' 'static_cast<Real>(job_.ior))'
mutant channel_weights_per_step chromatic_slab walk/path_weight.h \
  'ratio *= since;' 'throughput *= since / average(since);'
mutant hero_weighs_alone chromatic_bound walk/path_weight.h 'return p / average(p);' 'return p / p[hero];'
mutant entry_without_reflection mean_path_fresnel render/measured_walk.h 'Rgb(1 - fresnel.reflectance)' 'Rgb(1)'
mutant backward_not_swapped half_space_backward math/henyey_greenstein.h \
  'if (g < 0) std::swap(one_minus, one_plus);' ''
mutant total_reflection_lets_out mean_path_fresnel math/fresnel.h 'return {1, 0};' 'return {0, 0};'

# Lanes.
mutant lane_sign_of_g slab_forward_lanes walk/lane_kernels.cpp \
  'const float g = model_.medium.g;' 'const float g = -model_.medium.g;'
mutant lane_roulette_without_lift half_space_lanes walk/lane_kernels.cpp \
  'hn::IfThenElse(hn::And(plays, survives), hn::Div(lift, survival), lift)' 'lift'
mutant lane_azimuth_from_u1 slab_oblique_lanes walk/lane_kernels.cpp \
  'sincos_turns(F(), u2, sine, cosine);' 'sincos_turns(F(), u1, sine, cosine);'
mutant lane_azimuth_from_u1_too infinite_moments_lanes walk/lane_kernels.cpp \
  'const VF u2 = random.next(due);' 'const VF u2 = u1;'
mutant lane_albedo_of_red_alone chromatic_slab_lanes walk/lane_kernels.cpp \
  'hn::Mul(old, set(model_.medium.albedo[c]))' 'hn::Mul(old, set(c == 0 ? model_.medium.albedo[c] : Real(1)))'
mutant lane_exponent_upside_down chromatic_slab_lanes walk/lane_kernels.cpp \
  'set(least - sigma[c])' 'set(sigma[c] - least)'
mutant lane_density_not_normalised chromatic_slab_lanes walk/lane_kernels.cpp \
  'hn::Mul(exp_lanes(F(), power), set(sigma[c]))' 'exp_lanes(F(), power)'
mutant lane_ball_1_percent_large mean_path_lanes walk/lane_regions-inl.h \
  'hn::Le(sum, set(1))' 'hn::Le(sum, set(1.0201f))'
mutant lane_layer_too_thick slab_forward_lanes walk/lane_regions-inl.h \
  'hn::Ge(local, set(region_.low[i]))' 'hn::Ge(local, set(region_.low[i] - 0.02f))'
mutant lane_not_moved half_space_lanes walk/lane_kernels.cpp \
  'store(choose(safe, q, p), lanes_.position, at);' 'store(p, lanes_.position, at);'
mutant lane_uniform_paths infinite_moments_lanes walk/lane_kernels.cpp \
  'hn::Div(hn::Sub(rest, log_lanes(F(), hn::Sub(set(1), xi))), sigma)' 'hn::Div(hn::Add(xi, xi), sigma)'
mutant lane_backward_not_swapped half_space_backward_lanes walk/lane_kernels.cpp \
  'if (g < 0) {' 'if (false) {'
mutant lane_tallies_after_the_albedo sphere_fresnel_lanes walk/lane_kernels.cpp \
  'const VF left = hn::Mul(carried, set(1 - model_.medium.albedo.x));' \
  'const VF left = hn::Mul(carried, set(model_.medium.albedo.x * (1 - model_.medium.albedo.x)));'
mutant lane_exit_not_weighed chromatic_slab_lanes walk/lane_walks.h \
  'walker.weight.pass(model_.medium, crossing.distance);' ''
mutant lane_history_twice chromatic_slab_lanes walk/lane_walks.h \
  'if (walker.weight.order == put.order) {' 'if (true) {'
mutant lane_short_ray_skipped slab_forward_lanes walk/lane_walks.h \
  'return begun_[lane];' \
  'if (distance < Real(0.5)) return {CrossingKind::none, distance, position(lane) + distance * direction(lane)};
      return begun_[lane];'

# Meshes: empty balls and short rays.
mutant ray_behind_a_ball_skipped mean_path_knot_lanes walk/lane_walks.h \
  'if (clear == distance)' 'if (clear > 0)'
mutant clear_part_not_added mean_path_knot_lanes walk/lane_walks.h 'crossing.distance += clear;' ''
mutant ball_beyond_counts own_plate_lanes walk/lane_rays.cpp \
  'if (i > 0) open = hn::And(open, balls.hold(place));' ''
mutant any_ball_faces own_plate_lanes walk/lane_rays.cpp \
  'hn::Or(promise(balls, EmptyBall::facing), balls.hold(p))' 'hn::Gt(balls.radius2, set(0))'
mutant far_side_passed mean_path_knot_lanes walk/lane_rays.cpp '1 - 0x1p-10f' '1.02f'
mutant lane_takes_any_ball own_plate_lanes walk/lane_regions-inl.h \
  'hn::And(balls.hold(p), balls.hold(q))' 'balls.hold(q)'
mutant balls_2_percent_large mean_path_knot_lanes trace/empty_balls.cpp \
  'std::min({distance, room.x, room.y, room.z}) - body_' \
  'Real(1.02) * std::min({distance, room.x, room.y, room.z}) - body_'
mutant all_balls_face own_plate_lanes trace/empty_balls.cpp 'std::min(radius, depth - rounding)' 'radius'
mutant edges_missed edges trace/packet_rays-inl.h 'hn::Set(d, 0x1p-23f)' 'hn::Set(d, -0x1p-23f)'
mutant first_exit_kept mean_path_plates_lanes trace/ray_batch.cpp \
  '(t < limit_[pair.ray])' '(t < limit_[pair.ray] && best_[pair.ray] == kNone)'
mutant packet_planes_shrunk mean_path_knot_lanes trace/packet_rays-inl.h \
  'hn::And(hn::Le(from, slack), hn::Ge(to, hn::Neg(slack)))' \
  'hn::And(hn::Le(from, hn::Neg(slack)), hn::Ge(to, hn::Set(d, 0.002f)))'
mutant inside_by_the_nearest_wall picture_touching trace/geometry.cpp \
  'if (const auto depth = mesh.depth(p, d)) return *depth > 0;' ''
mutant second_wall_not_entered picture_touching_lanes trace/geometry.cpp 'inside && !placement.matched' 'false'
mutant entry_before_the_exit picture_divided trace/geometry.cpp \
  'if (!exit || !is_inside(mesh, origin, d)) return std::nullopt;' 'return std::nullopt;'
mutant wall_of_the_neighbour_met picture_touching_lanes walk/passage.inl \
  '!stuck && !meets_neighbour(crossing, here)' '!stuck'

# Paths.
mutant shadow_roulette_without_factor picture_fog_lanes walk/shadow_roulette.h 'return 1 / p;' 'return 1;'
mutant hero_always_red picture_furnace_lanes render/progressive.cpp '+ k) % 3);' '+ k) % 3) * 0;'
mutant pixels_without_corners picture_outline_lanes render/empty_pixels.cpp \
  'job.geometry->radius(i), spread));' 'job.geometry->radius(i), 0));'
mutant light_found_not_shared picture_lit walk/passage.inl \
  'average(passed) * pdf + average(weight.ratio) * sampled' 'average(passed) * pdf'
mutant no_light_at_collisions picture_fog_lanes walk/lane_walks.h \
  'client_.collided(seat_[lane], clearance(lane), walker, random);' ''
mutant lane_seats_mixed company_lanes walk/lane_walks.h 'std::swap(seat_[to], seat_[from]);' ''
mutant lane_put_left_behind company_lanes walk/lane_walks.h 'put_[to] = put_[from];' ''
