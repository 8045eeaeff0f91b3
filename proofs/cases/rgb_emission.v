(** * rgb-emission: One absorber with three emission colours

    Claim.  For every D on the ray, which has the length of the theorem's bound, the optical
    depth and the volume rendering integral of the field, extinction and emission below exist,
    and are [exact_depth D] and [exact_radiance D].

    Written by volver prove; not to be edited. *)

From Volver Require Import CaseTactic.

Module red.

Definition field (lambda : R) : R :=
  lambda.
Definition extinction (s : R) : R :=
  1 + 2 * s.
Definition emission (s : R) : R :=
  1.
Definition exact_depth (lambda : R) : R :=
  lambda + lambda ^ 2.
Definition exact_radiance (lambda : R) : R :=
  1 - exp (- (lambda + lambda ^ 2)).

Theorem rgb_emission_red (D : R) :
  0 <= D <= 1 ->
  is_RInt (extinction_along field extinction) 0 D (exact_depth D) /\
  is_RInt (integrand field extinction emission) 0 D (exact_radiance D).
Proof. prove_case. Qed.
End red.

Module green.

Definition field (lambda : R) : R :=
  lambda.
Definition extinction (s : R) : R :=
  1 + 2 * s.
Definition emission (s : R) : R :=
  s + s ^ 2.
Definition exact_depth (lambda : R) : R :=
  lambda + lambda ^ 2.
Definition exact_radiance (lambda : R) : R :=
  1 - (1 + lambda + lambda ^ 2) * exp (- (lambda + lambda ^ 2)).

Theorem rgb_emission_green (D : R) :
  0 <= D <= 1 ->
  is_RInt (extinction_along field extinction) 0 D (exact_depth D) /\
  is_RInt (integrand field extinction emission) 0 D (exact_radiance D).
Proof. prove_case. Qed.
End green.

Module blue.

Definition field (lambda : R) : R :=
  lambda.
Definition extinction (s : R) : R :=
  1 + 2 * s.
Definition emission (s : R) : R :=
  4 - 4 * (s + s ^ 2) + (s + s ^ 2) ^ 2.
Definition exact_depth (lambda : R) : R :=
  lambda + lambda ^ 2.
Definition exact_radiance (lambda : R) : R :=
  2 - (2 - 2 * (lambda + lambda ^ 2) + (lambda + lambda ^ 2) ^ 2) * exp (- (lambda + lambda ^ 2)).

Theorem rgb_emission_blue (D : R) :
  0 <= D <= 1 ->
  is_RInt (extinction_along field extinction) 0 D (exact_depth D) /\
  is_RInt (integrand field extinction emission) 0 D (exact_radiance D).
Proof. prove_case. Qed.
End blue.
