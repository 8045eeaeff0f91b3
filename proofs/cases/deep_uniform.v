(** * deep-uniform: The same dense medium everywhere, of depth 120

    Claim.  For every D on the ray, which has the length of the theorem's bound, the optical
    depth and the volume rendering integral of the field, extinction and emission below exist,
    and are [exact_depth D] and [exact_radiance D].

    Written by volver prove; not to be edited. *)

From Volver Require Import CaseTactic.

Module falling.

Definition field (lambda : R) : R :=
  lambda.
Definition extinction (s : R) : R :=
  240.
Definition emission (s : R) : R :=
  exp (-480 * s).
Definition exact_depth (lambda : R) : R :=
  240 * lambda.
Definition exact_radiance (lambda : R) : R :=
  1 / 3 * (1 - exp (-720 * lambda)).

Theorem deep_uniform_falling (D : R) :
  0 <= D <= 1 / 2 ->
  is_RInt (extinction_along field extinction) 0 D (exact_depth D) /\
  is_RInt (integrand field extinction emission) 0 D (exact_radiance D).
Proof. prove_case. Qed.
End falling.

Module rising.

Definition field (lambda : R) : R :=
  lambda.
Definition extinction (s : R) : R :=
  240.
Definition emission (s : R) : R :=
  1 + 480 * s.
Definition exact_depth (lambda : R) : R :=
  240 * lambda.
Definition exact_radiance (lambda : R) : R :=
  3 - (3 + 480 * lambda) * exp (-240 * lambda).

Theorem deep_uniform_rising (D : R) :
  0 <= D <= 1 / 2 ->
  is_RInt (extinction_along field extinction) 0 D (exact_depth D) /\
  is_RInt (integrand field extinction emission) 0 D (exact_radiance D).
Proof. prove_case. Qed.
End rising.

Module sloping.

Definition field (lambda : R) : R :=
  lambda.
Definition extinction (s : R) : R :=
  240.
Definition emission (s : R) : R :=
  1 + 24 / 5 * s.
Definition exact_depth (lambda : R) : R :=
  240 * lambda.
Definition exact_radiance (lambda : R) : R :=
  51 / 50 - (51 / 50 + 24 / 5 * lambda) * exp (-240 * lambda).

Theorem deep_uniform_sloping (D : R) :
  0 <= D <= 1 / 2 ->
  is_RInt (extinction_along field extinction) 0 D (exact_depth D) /\
  is_RInt (integrand field extinction emission) 0 D (exact_radiance D).
Proof. prove_case. Qed.
End sloping.

Module curved.

Definition field (lambda : R) : R :=
  lambda.
Definition extinction (s : R) : R :=
  240.
Definition emission (s : R) : R :=
  1 + 14400 * s ^ 2.
Definition exact_depth (lambda : R) : R :=
  240 * lambda.
Definition exact_radiance (lambda : R) : R :=
  3 / 2 - (3 / 2 + 120 * lambda + 1 / 4 * (240 * lambda) ^ 2) * exp (-240 * lambda).

Theorem deep_uniform_curved (D : R) :
  0 <= D <= 1 / 2 ->
  is_RInt (extinction_along field extinction) 0 D (exact_depth D) /\
  is_RInt (integrand field extinction emission) 0 D (exact_radiance D).
Proof. prove_case. Qed.
End curved.
