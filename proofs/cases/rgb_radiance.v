(** * rgb-radiance: Three chosen radiances behind one homogeneous absorber

    Claim.  For every D on the ray, which has the length of the theorem's bound, the optical
    depth and the volume rendering integral of the field, extinction and emission below exist,
    and are [exact_depth D] and [exact_radiance D].

    Written by volver prove; not to be edited. *)

From Volver Require Import CaseTactic.

Module red.

Definition field (lambda : R) : R :=
  lambda.
Definition extinction (s : R) : R :=
  1.
Definition emission (s : R) : R :=
  1 - s.
Definition exact_depth (lambda : R) : R :=
  lambda.
Definition exact_radiance (lambda : R) : R :=
  lambda * exp (- lambda).

Theorem rgb_radiance_red (D : R) :
  0 <= D <= 1 ->
  is_RInt (extinction_along field extinction) 0 D (exact_depth D) /\
  is_RInt (integrand field extinction emission) 0 D (exact_radiance D).
Proof. prove_case. Qed.
End red.

Module green.

Definition field (lambda : R) : R :=
  lambda.
Definition extinction (s : R) : R :=
  1.
Definition emission (s : R) : R :=
  2 * s - s ^ 2.
Definition exact_depth (lambda : R) : R :=
  lambda.
Definition exact_radiance (lambda : R) : R :=
  lambda ^ 2 * exp (- lambda).

Theorem rgb_radiance_green (D : R) :
  0 <= D <= 1 ->
  is_RInt (extinction_along field extinction) 0 D (exact_depth D) /\
  is_RInt (integrand field extinction emission) 0 D (exact_radiance D).
Proof. prove_case. Qed.
End green.

Module blue.

Definition field (lambda : R) : R :=
  lambda.
Definition extinction (s : R) : R :=
  1.
Definition emission (s : R) : R :=
  1 - s + 1 / 2 * s ^ 2.
Definition exact_depth (lambda : R) : R :=
  lambda.
Definition exact_radiance (lambda : R) : R :=
  1 - (1 + 1 / 2 * lambda ^ 2) * exp (- lambda).

Theorem rgb_radiance_blue (D : R) :
  0 <= D <= 1 ->
  is_RInt (extinction_along field extinction) 0 D (exact_depth D) /\
  is_RInt (integrand field extinction emission) 0 D (exact_radiance D).
Proof. prove_case. Qed.
End blue.
