// What a run says of itself: the keys of --stats, and the attributes that its images carry.
#pragma once

#include <optional>
#include <string>

#include "film/sample_ranges.h"
#include "io/image_file.h"
#include "render/progressive.h"

namespace meander {

[[nodiscard]] std::string version_text();

/// The JSON text of --stats, keys as the command line's contract lists them; `ended_by` is the value of that
/// key.
[[nodiscard]] std::string stats_json(const Job& job, const Rendering& rendering, const char* ended_by);

/// The attributes that hold the relative noise of --stats, and the number of pixels that it is of.
inline constexpr const char* kNoiseAttribute = "meander/relative_noise";
inline constexpr const char* kNoisePixelsAttribute = "meander/noise_pixels";

/// Adds both.
void add_noise(double noise, std::int64_t pixels, ImageAttributes& attributes);

/// The attribute that tells scenes apart (scene/scene_digest.h), as hexadecimal text.
inline constexpr const char* kDigestAttribute = "meander/scene_digest";

/// scene and its digest, seed, spp, first sample and version; the relative noise, and of how many pixels it
/// is, where there is one.
[[nodiscard]] ImageAttributes image_attributes(const Job& job, const Rendering& rendering);

/// What says of which samples a pixel an image is made (not empty, disjoint): meander/spp, and meander/seed
/// and meander/first_sample where it is one range; as meander/samples (film/sample_ranges.h) where it is not.
void add_samples(const SampleRanges& samples, ImageAttributes& attributes);

/// The samples that attributes speak of; nothing when they do not, or make no sense.
[[nodiscard]] std::optional<SampleRanges> samples_of(const ImageAttributes& attributes);

}  // namespace meander
