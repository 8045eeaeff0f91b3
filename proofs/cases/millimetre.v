(** * millimetre: An oscillating medium on a ray of a thousandth

    Claim.  For every D on the ray, which has the length of the theorem's bound, the optical
    depth and the volume rendering integral of the field, extinction and emission below exist,
    and are [exact_depth D] and [exact_radiance D].

    Written by volver prove; not to be edited. *)

From Volver Require Import CaseTactic.

Module even.

Definition field (lambda : R) : R :=
  lambda.
Definition extinction (s : R) : R :=
  2000 + 1000 * cos (3000 * s).
Definition emission (s : R) : R :=
  1.
Definition exact_depth (lambda : R) : R :=
  2000 * lambda + 1 / 3 * sin (3000 * lambda).
Definition exact_radiance (lambda : R) : R :=
  1 - exp (- (2000 * lambda + 1 / 3 * sin (3000 * lambda))).

Theorem millimetre_even (D : R) :
  0 <= D <= 1 / 1000 ->
  is_RInt (extinction_along field extinction) 0 D (exact_depth D) /\
  is_RInt (integrand field extinction emission) 0 D (exact_radiance D).
Proof. prove_case. Qed.
End even.

Module rising.

Definition field (lambda : R) : R :=
  lambda.
Definition extinction (s : R) : R :=
  2000 + 1000 * cos (3000 * s).
Definition emission (s : R) : R :=
  1 + 2000 * s + 1 / 3 * sin (3000 * s).
Definition exact_depth (lambda : R) : R :=
  2000 * lambda + 1 / 3 * sin (3000 * lambda).
Definition exact_radiance (lambda : R) : R :=
  2 - (2 + 2000 * lambda + 1 / 3 * sin (3000 * lambda)) * exp (- (2000 * lambda + 1 / 3 * sin (3000 * lambda))).

Theorem millimetre_rising (D : R) :
  0 <= D <= 1 / 1000 ->
  is_RInt (extinction_along field extinction) 0 D (exact_depth D) /\
  is_RInt (integrand field extinction emission) 0 D (exact_radiance D).
Proof. prove_case. Qed.
End rising.

Module sloping.

Definition field (lambda : R) : R :=
  lambda.
Definition extinction (s : R) : R :=
  2000 + 1000 * cos (3000 * s).
Definition emission (s : R) : R :=
  3 - 1 / 3 * sin (3000 * s) - 2000 * s.
Definition exact_depth (lambda : R) : R :=
  2000 * lambda + 1 / 3 * sin (3000 * lambda).
Definition exact_radiance (lambda : R) : R :=
  2 - (2 - (2000 * lambda + 1 / 3 * sin (3000 * lambda))) * exp (- (2000 * lambda + 1 / 3 * sin (3000 * lambda))).

Theorem millimetre_sloping (D : R) :
  0 <= D <= 1 / 1000 ->
  is_RInt (extinction_along field extinction) 0 D (exact_depth D) /\
  is_RInt (integrand field extinction emission) 0 D (exact_radiance D).
Proof. prove_case. Qed.
End sloping.

Module curved.

Definition field (lambda : R) : R :=
  lambda.
Definition extinction (s : R) : R :=
  2000 + 1000 * cos (3000 * s).
Definition emission (s : R) : R :=
  1 + 1 / 4 * (2000 * s + 1 / 3 * sin (3000 * s)) ^ 2.
Definition exact_depth (lambda : R) : R :=
  2000 * lambda + 1 / 3 * sin (3000 * lambda).
Definition exact_radiance (lambda : R) : R :=
  3 / 2 - (3 / 2 + 1 / 2 * (2000 * lambda + 1 / 3 * sin (3000 * lambda)) + 1 / 4 * (2000 * lambda + 1 / 3 * sin (3000 * lambda)) ^ 2) * exp (- (2000 * lambda + 1 / 3 * sin (3000 * lambda))).

Theorem millimetre_curved (D : R) :
  0 <= D <= 1 / 1000 ->
  is_RInt (extinction_along field extinction) 0 D (exact_depth D) /\
  is_RInt (integrand field extinction emission) 0 D (exact_radiance D).
Proof. prove_case. Qed.
End curved.
