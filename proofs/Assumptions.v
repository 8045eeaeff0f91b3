(** * What the theorems rest on

    Prints everything that the theorems, taken together, assume without proof (one
    at a time would take half a minute).  [check] compares that with the short list
    of what Coq's own real numbers rest on, and sees to it that no theorem of the
    other files is missing here. *)

From Volver Require Integral Cases Order.

Definition theorems := (
  @Integral.manufactured_optical_depth,
  @Integral.manufactured_optical_depth_eq,
  @Integral.manufactured_radiance,
  @Integral.manufactured_radiance_eq,
  @Cases.SineSquared.optical_depth_integral,
  @Cases.SineSquared.optical_depth_eq,
  @Cases.SineSquared.radiance_integral,
  @Cases.SineSquared.radiance_eq,
  @Cases.Reciprocal.optical_depth_integral,
  @Cases.Reciprocal.optical_depth_eq,
  @Cases.Reciprocal.radiance_integral,
  @Cases.Reciprocal.radiance_eq,
  @Cases.HomogeneousSlab.optical_depth_integral,
  @Cases.HomogeneousSlab.optical_depth_eq,
  @Cases.HomogeneousSlab.radiance_integral,
  @Cases.HomogeneousSlab.radiance_eq,
  @Cases.ReciprocalSquare.optical_depth_integral,
  @Cases.ReciprocalSquare.optical_depth_eq,
  @Cases.ReciprocalSquare.radiance_integral,
  @Cases.ReciprocalSquare.radiance_eq,
  @Order.min_order_bound,
  @Order.min_order).

Print Assumptions theorems.
