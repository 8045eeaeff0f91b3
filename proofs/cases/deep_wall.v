(** * deep-wall: A wall of depth 200, seen through a thin front

    Claim.  For every D on the ray, which has the length of the theorem's bound, the optical
    depth and the volume rendering integral of the field, extinction and emission below exist,
    and are [exact_depth D] and [exact_radiance D].

    Written by volver prove; not to be edited. *)

From Volver Require Import CaseTactic.

Module even.

Definition field (lambda : R) : R :=
  lambda.
Definition extinction (s : R) : R :=
  1 / 20 + 200 / sqrt PI * exp (- (s - 6) ^ 2).
Definition emission (s : R) : R :=
  1.
Definition exact_depth (lambda : R) : R :=
  1 / 20 * lambda + 100 * (erf (lambda - 6) + erf 6).
Definition exact_radiance (lambda : R) : R :=
  1 - exp (- (1 / 20 * lambda + 100 * (erf (lambda - 6) + erf 6))).

Theorem deep_wall_even (D : R) :
  0 <= D <= 10 ->
  is_RInt (extinction_along field extinction) 0 D (exact_depth D) /\
  is_RInt (integrand field extinction emission) 0 D (exact_radiance D).
Proof. prove_case. Qed.
End even.

Module rising.

Definition field (lambda : R) : R :=
  lambda.
Definition extinction (s : R) : R :=
  1 / 20 + 200 / sqrt PI * exp (- (s - 6) ^ 2).
Definition emission (s : R) : R :=
  1 + 1 / 20 * s + 100 * (erf (s - 6) + erf 6).
Definition exact_depth (lambda : R) : R :=
  1 / 20 * lambda + 100 * (erf (lambda - 6) + erf 6).
Definition exact_radiance (lambda : R) : R :=
  2 - (2 + 1 / 20 * lambda + 100 * (erf (lambda - 6) + erf 6)) * exp (- (1 / 20 * lambda + 100 * (erf (lambda - 6) + erf 6))).

Theorem deep_wall_rising (D : R) :
  0 <= D <= 10 ->
  is_RInt (extinction_along field extinction) 0 D (exact_depth D) /\
  is_RInt (integrand field extinction emission) 0 D (exact_radiance D).
Proof. prove_case. Qed.
End rising.

Module sloping.

Definition field (lambda : R) : R :=
  lambda.
Definition extinction (s : R) : R :=
  1 / 20 + 200 / sqrt PI * exp (- (s - 6) ^ 2).
Definition emission (s : R) : R :=
  1 + 2 * erf 6 + 2 * erf (-6 + s) + 1 / 1000 * s.
Definition exact_depth (lambda : R) : R :=
  1 / 20 * lambda + 100 * (erf (lambda - 6) + erf 6).
Definition exact_radiance (lambda : R) : R :=
  51 / 50 - (51 / 50 + 1 / 50 * (1 / 20 * lambda + 100 * (erf (lambda - 6) + erf 6))) * exp (- (1 / 20 * lambda + 100 * (erf (lambda - 6) + erf 6))).

Theorem deep_wall_sloping (D : R) :
  0 <= D <= 10 ->
  is_RInt (extinction_along field extinction) 0 D (exact_depth D) /\
  is_RInt (integrand field extinction emission) 0 D (exact_radiance D).
Proof. prove_case. Qed.
End sloping.

Module curved.

Definition field (lambda : R) : R :=
  lambda.
Definition extinction (s : R) : R :=
  1 / 20 + 200 / sqrt PI * exp (- (s - 6) ^ 2).
Definition emission (s : R) : R :=
  1 + 1 / 4 * (1 / 20 * s + 100 * (erf (s - 6) + erf 6)) ^ 2.
Definition exact_depth (lambda : R) : R :=
  1 / 20 * lambda + 100 * (erf (lambda - 6) + erf 6).
Definition exact_radiance (lambda : R) : R :=
  3 / 2 - (3 / 2 + 1 / 2 * (1 / 20 * lambda + 100 * (erf (lambda - 6) + erf 6)) + 1 / 4 * (1 / 20 * lambda + 100 * (erf (lambda - 6) + erf 6)) ^ 2) * exp (- (1 / 20 * lambda + 100 * (erf (lambda - 6) + erf 6))).

Theorem deep_wall_curved (D : R) :
  0 <= D <= 10 ->
  is_RInt (extinction_along field extinction) 0 D (exact_depth D) /\
  is_RInt (integrand field extinction emission) 0 D (exact_radiance D).
Proof. prove_case. Qed.
End curved.
