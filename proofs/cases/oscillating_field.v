(** * oscillating-field: Transfer functions of a field that oscillates

    Claim.  For every D on the ray, which has the length of the theorem's bound, the optical
    depth and the volume rendering integral of the field, extinction and emission below exist,
    and are [exact_depth D] and [exact_radiance D].

    Written by volver prove; not to be edited. *)

From Volver Require Import CaseTactic.

Definition field (lambda : R) : R :=
  sin (3 * lambda).
Definition extinction (s : R) : R :=
  2 + s.
Definition emission (s : R) : R :=
  1 / 2 * (2 + s) ^ 2 + 18 * (1 + s) / (2 + s).
Definition exact_depth (lambda : R) : R :=
  2 * lambda + 1 / 3 * (1 - cos (3 * lambda)).
Definition exact_radiance (lambda : R) : R :=
  14 - (9 + 1 / 2 * (2 + sin (3 * lambda)) ^ 2 + 3 * cos (3 * lambda)) * exp (-2 * lambda - 1 / 3 * (1 - cos (3 * lambda))).

Theorem oscillating_field (D : R) :
  0 <= D <= 4 ->
  is_RInt (extinction_along field extinction) 0 D (exact_depth D) /\
  is_RInt (integrand field extinction emission) 0 D (exact_radiance D).
Proof. prove_case. Qed.
