(** * atmosphere: An atmosphere whose density falls exponentially

    Claim.  For every D on the ray, which has the length of the theorem's bound, the optical
    depth and the volume rendering integral of the field, extinction and emission below exist,
    and are [exact_depth D] and [exact_radiance D].

    Written by volver prove; not to be edited. *)

From Volver Require Import CaseTactic.

Definition field (lambda : R) : R :=
  lambda.
Definition extinction (s : R) : R :=
  1 / 10 * exp (-1 / 20 * s).
Definition emission (s : R) : R :=
  3 - 2 * exp (-1 / 20 * s).
Definition exact_depth (lambda : R) : R :=
  2 - 2 * exp (-1 / 20 * lambda).
Definition exact_radiance (lambda : R) : R :=
  2 - (4 - 2 * exp (-1 / 20 * lambda)) * exp (- (2 - 2 * exp (-1 / 20 * lambda))).

Theorem atmosphere (D : R) :
  0 <= D <= 200 ->
  is_RInt (extinction_along field extinction) 0 D (exact_depth D) /\
  is_RInt (integrand field extinction emission) 0 D (exact_radiance D).
Proof. prove_case. Qed.
